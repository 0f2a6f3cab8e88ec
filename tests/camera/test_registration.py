# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.registration import Extrinsics, color_in_depth
from tricue.camera.rig import Intrinsics

DEPTH = Intrinsics(60.0, 60.0, 19.5, 14.5, 40, 30)
COLOR = Intrinsics(90.0, 90.0, 39.5, 24.5, 80, 50)


def dot(camera: Intrinsics, point: tuple[float, float, float]) -> np.ndarray:
    """A black picture with a white square of 5 pixels at a point of space."""
    image = np.zeros((camera.height, camera.width, 3), np.uint8)
    column, row = np.rint(camera.project(point)).astype(int)
    image[row - 2 : row + 3, column - 2 : column + 3] = 255
    return image


def middle(image: np.ndarray) -> np.ndarray:
    """The mean place (u, v) of what isn't black, by brightness."""
    rows, columns = np.nonzero(image[..., 0])
    return np.average(np.column_stack([columns, rows]), axis=0, weights=image[rows, columns, 0])


@pytest.mark.parametrize("shift", [0.0, 0.1])
def test_a_point_has_its_color(shift: float) -> None:
    """A thing that both cameras see is, in the depth camera's pixels, where that camera sees it."""
    point = (0.2, -0.15, 2.0)
    moved = (point[0] + shift, *point[1:])
    extrinsics = Extrinsics(translation=np.array([shift, 0, 0])) if shift else None
    depth = np.full((30, 40), point[2], np.float32)
    found = color_in_depth(dot(COLOR, moved), depth, DEPTH, COLOR, extrinsics)
    assert found.shape == (30, 40, 3)
    np.testing.assert_allclose(middle(found), DEPTH.project(point), atol=0.5)


def test_turned_cameras() -> None:
    """A camera on its side is turned back."""
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    point = np.array([0.1, -0.2, 2.0])
    found = color_in_depth(
        dot(COLOR, turn @ point), np.full((30, 40), 2.0), DEPTH, COLOR, Extrinsics(rotation=turn)
    )
    np.testing.assert_allclose(middle(found), DEPTH.project(point), atol=0.5)


def test_one_camera_gives_the_same_image() -> None:
    """With the same camera nothing changes, measured or not."""
    rng = np.random.default_rng(0)
    image = rng.integers(0, 256, (30, 40, 3), dtype=np.uint8)
    depth = np.where(rng.random((30, 40)) < 0.5, np.nan, 2.0)
    np.testing.assert_array_equal(color_in_depth(image, depth, DEPTH, DEPTH), image)


def test_nothing_measured_is_far() -> None:
    """Where the depth is 0 or NaN a translation has no effect."""
    image = np.random.default_rng(1).integers(0, 256, (30, 40, 3), dtype=np.uint8)
    depth = np.zeros((30, 40))
    depth[::2] = np.nan
    found = color_in_depth(image, depth, DEPTH, DEPTH, Extrinsics(translation=np.array([0.3, 0, 0])))
    np.testing.assert_array_equal(found, image)


def test_outside_is_black() -> None:
    """What the color camera doesn't see is black: here all but its narrow view's middle."""
    narrow = Intrinsics(600.0, 600.0, 19.5, 14.5, 40, 30)
    found = color_in_depth(np.full((30, 40, 3), 200, np.uint8), np.ones((30, 40)), DEPTH, narrow)
    assert found[14, 19].tolist() == [200] * 3
    assert found[0, 0].tolist() == [0] * 3


def test_sizes_are_checked() -> None:
    """An image of another size than its camera is named."""
    image, depth = np.zeros((50, 80, 3), np.uint8), np.ones((30, 40))
    with pytest.raises(ValueError, match=r"^depth: expected its camera's size, 40x30, got 80x50"):
        color_in_depth(image, np.ones((50, 80)), DEPTH, COLOR)
    with pytest.raises(ValueError, match=r"^color: expected its camera's size, 80x50, got 40x30"):
        color_in_depth(np.zeros((30, 40, 3), np.uint8), depth, DEPTH, COLOR)
