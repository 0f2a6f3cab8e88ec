# SPDX-License-Identifier: MIT
import math
import re
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue.camera.registration import Extrinsics, Registration, Reprojection, color_in_depth
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


@pytest.mark.parametrize("z", [0.7, 2.0])
@pytest.mark.parametrize("shift", [0.0, 0.1])
def test_a_point_has_its_color(shift: float, z: float) -> None:
    """A thing that both cameras see is, in the depth camera's pixels, where that camera sees it."""
    point = (0.1 * z, -0.075 * z, z)
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


@pytest.mark.parametrize(
    ("depth", "error", "message"),
    [
        (
            np.full((30, 40), 2000, np.uint16),
            TypeError,
            "floats, meters, got uint16 (30, 40); 0.001 * depth for",
        ),
        (None, TypeError, "floats, meters, got object ()"),
        (np.ones((30, 40, 1)), ValueError, "one value a pixel, (H, W), got float64 (30, 40, 1)"),
    ],
)
def test_what_is_no_depth_in_meters_is_refused(depth: Any, error: type[Exception], message: str) -> None:
    """Millimeters would be thousands of meters, where two cameras apart from each other see the same."""
    reprojection = Reprojection(DEPTH, COLOR, Extrinsics(translation=np.array([0.1, 0, 0])))
    with pytest.raises(error, match=rf"^depth: expected {re.escape(message)}"):
        reprojection(depth)
    with pytest.raises(error, match=rf"^depth: expected {re.escape(message)}"):
        Registration(DEPTH, COLOR)(depth)
    with pytest.raises(error, match=rf"^depth: expected {re.escape(message)}"):
        color_in_depth(np.zeros((50, 80, 3), np.uint8), depth, DEPTH, COLOR)


REGISTRATION = Registration(DEPTH, COLOR)


def plane(camera: Intrinsics, normal: tuple[float, float, float]) -> np.ndarray:
    """The exact depth of the plane normal . point = 1 in each pixel."""
    u, v = np.meshgrid(np.arange(camera.width), np.arange(camera.height))
    return 1 / (camera.back_project(u, v, 1.0) @ np.array(normal))


def test_depth_is_that_of_the_ray() -> None:
    """A slanted plane has, in the color camera's pixels, the depth that this camera would measure, to what it
    changes in half a pixel of the depth image; outside of the depth image there is none.
    """
    normal, color = (0.05, -0.08, 0.5), Intrinsics(91.0, 93.0, 39.2, 24.7, 80, 50)
    found, true = Registration(DEPTH, color)(plane(DEPTH, normal)), plane(color, normal)
    assert found.shape == (color.height, color.width)
    assert found.dtype == np.float32
    seen = DEPTH.project(color.back_project(*np.meshgrid(np.arange(80), np.arange(50)), 1.0))
    inside = ((seen > -0.5) & (seen < (DEPTH.width - 0.5, DEPTH.height - 0.5))).all(axis=-1)
    np.testing.assert_array_equal(np.isnan(found), ~inside)
    half = true**2 * (abs(normal[0]) / DEPTH.fx + abs(normal[1]) / DEPTH.fy) / 2  # of dz = z^2 n du / f
    assert (np.abs(found - true)[inside] <= 1.01 * half[inside]).all()


def test_both_ways_agree() -> None:
    """What is near in the depth image is, in the color image, where color_in_depth takes its color from: to a
    pixel of either camera.
    """
    depth = np.full((30, 40), 4.0, np.float32)
    depth[8:20, 12:25] = 2.0
    near = np.where(REGISTRATION(depth) < 3, np.uint8(255), np.uint8(0))
    back = color_in_depth(np.dstack(3 * [near]), depth, DEPTH, COLOR)[..., 0] > 127
    assert ((depth < 3) & ~back).sum() == 0
    assert (back & ~(depth < 3)).sum() <= 2 * (12 + 13)


def test_edges_stay_edges() -> None:
    """There is no depth between two things: all that comes out was measured."""
    depth = np.where(np.arange(40) < 20, 1.5, 4.0) * np.ones((30, 1))
    found = REGISTRATION(depth)
    assert set(np.unique(found[~np.isnan(found)])) == {1.5, 4.0}


def test_depth_of_the_same_camera_is_the_same() -> None:
    """With the same camera nothing changes, nor does what wasn't measured."""
    depth = np.random.default_rng(0).uniform(0, 8, (30, 40)).astype(np.float32)
    depth[::3, ::4] = np.nan
    np.testing.assert_array_equal(Registration(DEPTH, DEPTH)(depth), depth)


def test_boxes_go_with_the_depth() -> None:
    """A box in the depth image's pixels is, in the color image's, round the same depth; an unknown one stays
    unknown.
    """
    depth = np.full((30, 40), np.nan, np.float32)
    depth[8:20, 12:25] = 2.0
    found = REGISTRATION.boxes(np.array([[12.0, 8, 13, 12], 4 * [np.nan]]))
    rows, columns = np.nonzero(REGISTRATION(depth) == 2)
    edges = columns.min(), rows.min(), columns.max() + 1, rows.max() + 1
    corners = [*found[0, :2], *(found[0, :2] + found[0, 2:])]
    np.testing.assert_allclose(corners, edges, atol=0.5 + 1e-9)
    assert np.isnan(found[1]).all()


def test_depth_of_another_size_is_named() -> None:
    """Depth of another size than its camera's is an error."""
    with pytest.raises(ValueError, match=r"^depth: expected its camera's size, 40x30, got 80x50"):
        REGISTRATION(np.ones((50, 80), np.float32))


def slowly_reprojected(depth: NDArray[np.float32], way: Reprojection) -> NDArray[np.float64]:
    """Pixel by pixel: the nearest depth whose pixel's outline, projected, holds the color pixel's center."""
    found = np.full((way.color.height, way.color.width), np.inf)
    for (v, u), z in np.ndenumerate(depth):
        if not (np.isfinite(z) and z > 0):
            continue
        right, down = np.array([[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5], [0, 0]]).T
        corners = way.depth.back_project(u + right, v + down, z)
        placed = corners @ way.extrinsics.rotation.T + way.extrinsics.translation
        outline = way.color.project(placed[:4])
        low, high = outline.min(axis=0), outline.max(axis=0)
        for y in range(max(0, math.ceil(low[1])), min(way.color.height, math.ceil(high[1]))):
            for x in range(max(0, math.ceil(low[0])), min(way.color.width, math.ceil(high[0]))):
                found[y, x] = min(found[y, x], placed[4, 2])
    return np.where(np.isinf(found), np.nan, found)


@pytest.mark.parametrize("scale", [0.5, 1.0, 2.3])
def test_reprojection_agrees_with_loops(scale: float) -> None:
    """It proves for color cameras of several sizes, turned and moved, that depth lands where a loop over all
    pixels puts it, nearest first.
    """
    rng = np.random.default_rng(5)
    depth_camera = Intrinsics(40, 41, 15.2, 11.7, 32, 24)
    width, height = round(32 * scale), round(24 * scale)
    color_camera = Intrinsics(44 * scale, 43 * scale, width / 2, height / 2, width, height)
    turn = cv2.Rodrigues(np.array([0.02, -0.03, 0.05]))[0]
    way = Reprojection(depth_camera, color_camera, Extrinsics(turn, np.array([0.05, -0.02, 0.01])))
    depth = rng.uniform(0.7, 3.0, (24, 32)).astype(np.float32)
    depth[rng.uniform(size=depth.shape) < 0.1] = 0
    depth[3, 4], depth[5, 6] = np.nan, np.inf
    found, expected = way(depth), slowly_reprojected(depth, way)
    assert found.shape == (height, width)
    # a pixel's center may lie within float32's rounding of an outline
    assert np.isclose(found, expected, rtol=1e-5, equal_nan=True).mean() > 0.998
    assert 0.5 < np.isfinite(found).mean() < 1


def test_reprojection_without_motion_is_the_image_itself() -> None:
    """It proves that one camera in one place gets its own depth back."""
    camera = Intrinsics(40, 40, 15.5, 11.5, 32, 24)
    depth = np.random.default_rng(0).uniform(0.5, 4, (24, 32)).astype(np.float32)
    assert np.allclose(Reprojection(camera, camera, Extrinsics())(depth), depth, rtol=1e-6)
    with pytest.raises(ValueError, match="depth: expected its camera's size, 32x24, got 31x24"):
        Reprojection(camera, camera, Extrinsics())(depth[:, :-1])


@pytest.mark.parametrize("scale", [8, 24])
def test_a_much_finer_color_image_has_no_gaps(scale: int) -> None:
    """Every color pixel that looks at a wall has its depth, however few pixels the depth camera has."""
    coarse = Intrinsics.from_fov(32, 24, 60.0)
    fine = Intrinsics.from_fov(32 * scale, 24 * scale, 60.0)
    found = Reprojection(coarse, fine, Extrinsics())(np.full((24, 32), 2.0, np.float32))
    np.testing.assert_allclose(found, 2.0, rtol=1e-6)


def test_a_color_camera_finer_along_one_axis_has_no_gaps() -> None:
    """Its pixels may be smaller along x alone, or along y alone."""
    coarse = Intrinsics(30, 30, 3.5, 2.5, 8, 6)
    for across, down in ((24, 1), (1, 24)):
        center = (8 * across - 1) / 2, (6 * down - 1) / 2
        fine = Intrinsics(30 * across, 30 * down, *center, 8 * across, 6 * down)
        found = Reprojection(coarse, fine, Extrinsics())(np.full((6, 8), 2.0, np.float32))
        np.testing.assert_allclose(found, 2.0, rtol=1e-6)


def test_a_wall_close_to_the_color_camera_has_no_gaps() -> None:
    """A depth pixel covers more color pixels, the nearer the color camera is to what it saw."""
    camera = Intrinsics(40, 40, 15.5, 11.5, 32, 24)
    forward = Extrinsics(translation=np.array([0.0, 0.0, -1.8]))
    found = Reprojection(camera, camera, forward)(np.full((24, 32), 2.0, np.float32))
    np.testing.assert_allclose(found, 0.2, rtol=1e-5)


def test_a_color_camera_upside_down_sees_the_depth_so() -> None:
    """A half turn about the line of sight turns the image, and leaves every depth."""
    camera = Intrinsics(40, 40, 15.5, 11.5, 32, 24)
    depth = np.random.default_rng(0).uniform(0.5, 4, (24, 32)).astype(np.float32)
    turned = Reprojection(camera, camera, Extrinsics(np.diag([-1.0, -1.0, 1.0])))(depth)
    np.testing.assert_allclose(turned, depth[::-1, ::-1], rtol=1e-6)


@pytest.mark.parametrize("degrees", [2, 45, -45, 70])
def test_a_color_camera_that_is_turned_sees_a_wall_without_gaps(degrees: float) -> None:
    """At any angle about the line of sight every pixel inside of the depth image has a depth."""
    camera, turn = Intrinsics(40, 40, 15.5, 15.5, 32, 32), np.array([0, 0, math.radians(degrees)])
    way = Reprojection(camera, camera, Extrinsics(cv2.Rodrigues(turn)[0]))
    found = way(np.full((32, 32), 2.0, np.float32))
    np.testing.assert_allclose(found[6:26, 6:26], 2.0, rtol=1e-6)


def test_what_is_near_hides_what_is_behind() -> None:
    """It proves that the nearer surface is taken where both fall on one pixel."""
    camera = Intrinsics(40, 40, 15.5, 11.5, 32, 24)
    depth = np.full((24, 32), 4.0, np.float32)
    depth[:, 16:20] = 1.0
    moved = Reprojection(camera, camera, Extrinsics(np.eye(3), np.array([-0.2, 0.0, 0.0])))(depth)
    assert (moved[:, 8:12] == 1.0).all()  # 40 px * 0.2 m / 1 m to the left
    assert (moved[:, :8] == 4.0).all()
    assert np.isnan(moved[:, 14:18]).any()  # what it hid, 2 px shifted, has no depth
