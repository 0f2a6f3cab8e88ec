# SPDX-License-Identifier: MIT
"""The right image of a verged pair, as a parallel camera would see it."""

from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy import ndimage
from tricue import _core, reference
from tricue.kernels import Kernels
from tricue.track.flow_depth.cues import GradientMatching

Image = NDArray[np.uint8]
Floats = NDArray[np.float64]

SHAPE = (200, 256)
FOCAL, CENTER = 300.0, (120.0, 105.5)
BASELINE = 0.3


def clouds(seed: int, shape: tuple[int, ...]) -> Floats:
    """Texture without an end: 128 +- 40 gray levels."""
    noise = np.random.default_rng(seed).normal(size=shape)
    smooth = ndimage.gaussian_filter(noise, (2, 2, 0)[: len(shape)], mode="wrap")
    return 128 + 40 * smooth / smooth.std()


def ramp(axis: int) -> Image:
    """An image whose gray levels are its columns (axis 1) or rows (0)."""
    return np.broadcast_to(np.indices(SHAPE)[axis], SHAPE).astype(np.uint8)


def project(points: Floats, angle: float) -> Floats:
    """(N, 2) pixels of points (N, 3) of the left camera's frame in a right camera turned inwards."""
    cos, sin = np.cos(angle), np.sin(angle)
    axes = np.array([[cos, 0, sin], [0, 1, 0], [-sin, 0, cos]])  # x right, y down, z along the optical axis
    x, y, z = axes @ (points - [BASELINE, 0, 0]).T
    return np.stack([FOCAL * x / z + CENTER[0], FOCAL * y / z + CENTER[1]], axis=1)


def seen_points(angle: float) -> tuple[Floats, Floats, Floats]:
    """Points, and where the parallel and the turned camera see them, 3 px or more inside both."""
    points = np.random.default_rng(0).uniform([-1.5, -1.5, 1], [1.5, 1.5, 6], (4000, 3))
    parallel, turned = project(points, 0.0), project(points, angle)
    limit = np.array(SHAPE[::-1]) - 4
    seen = ((parallel >= 3) & (parallel <= limit) & (turned >= 3) & (turned <= limit)).all(axis=1)
    assert seen.sum() > 300
    return points[seen], parallel[seen], turned[seen]


def sample(image: Image, places: Floats) -> Floats:
    """Gray levels at pixels (N, 2) x, y; between those of the image linearly."""
    return np.asarray(ndimage.map_coordinates(image.astype(np.float64), places[:, ::-1].T, order=1))


@pytest.mark.parametrize("angle", [0.0, 0.1, -0.25, 1.2, -1.5])
@pytest.mark.parametrize(
    "changes", [{}, {"rows_only": True}, {"shift": 20.5}, {"center": (-30.0, 90.25)}], ids=str
)
@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (40, 53), (31, 8, 3), (6, 1, 3)], ids=str)
def test_twin_sees_the_same(angle: float, changes: dict[str, Any], shape: tuple[int, ...]) -> None:
    """Native and twin give the same pixels, gray and color, whatever the angle; where their sines differ in
    the last bit, a place may be rounded the other way, which is less than a gray level.
    """
    image = np.random.default_rng(1).integers(0, 256, shape).astype(np.uint8)
    found = _core.rectify_verged(image, angle, 60.0, **changes)
    expected = reference.rectify_verged(image, angle, 60.0, **changes)
    assert found.dtype == expected.dtype == np.uint8
    assert found.shape == expected.shape == image.shape
    assert abs(found.astype(int) - expected).max() <= 1
    assert (found != expected).sum() <= 1 + found.size // 1000


def test_rows_may_be_padded() -> None:
    """A view into a larger image gives what its copy gives."""
    image = np.random.default_rng(2).integers(0, 256, (50, 60, 3)).astype(np.uint8)
    view = image[5:40, 7:50]
    found = _core.rectify_verged(view, 0.1, 60.0)
    assert_array_equal(found, _core.rectify_verged(view.copy(), 0.1, 60.0))


@pytest.mark.parametrize("angle", [0.05, 0.2, -0.1])
def test_points_come_to_where_the_parallel_camera_sees_them(kernels: Kernels, angle: float) -> None:
    """At a point's parallel projection lies the pixel of its turned one, to the rounding of gray levels."""
    _, parallel, turned = seen_points(angle)
    for axis in (0, 1):
        image = kernels.rectify_verged(ramp(axis), angle, FOCAL, CENTER)
        assert_allclose(sample(image, parallel), turned[:, 1 - axis], rtol=0, atol=0.51)


@pytest.mark.parametrize("angle", [0.05, 0.2, -0.1])
def test_rows_only_is_equation_8(kernels: Kernels, angle: float) -> None:
    """With the columns left, at (x_R, y_L) lies the pixel (x_R, y_R): projected points satisfy (8)."""
    _, parallel, turned = seen_points(angle)
    image = kernels.rectify_verged(ramp(0), angle, FOCAL, CENTER, rows_only=True)
    places = np.stack([turned[:, 0], parallel[:, 1]], axis=1)
    inside = (places[:, 1] >= 1) & (places[:, 1] <= SHAPE[0] - 2)
    assert_allclose(sample(image, places[inside]), turned[inside, 1], rtol=0, atol=0.51)
    x, y = (turned - CENTER)[:, 0], (parallel - CENTER)[:, 1]
    rows = y * (np.cos(angle) + x * np.sin(angle) / FOCAL)
    assert_allclose(rows, turned[:, 1] - CENTER[1], rtol=0, atol=1e-9)


@pytest.mark.parametrize("angle", [0.07, -0.2])
def test_is_the_homography_of_the_rotation(kernels: Kernels, angle: float) -> None:
    """cv2.warpPerspective by K R K^-1, whose weights are those of 1/32 px, differs by at most 2 levels."""
    image = np.rint(clouds(3, (*SHAPE, 3))).clip(0, 255).astype(np.uint8)
    camera = np.array([[FOCAL, 0, CENTER[0]], [0, FOCAL, CENTER[1]], [0, 0, 1]])
    rotation, _ = cv2.Rodrigues(np.array([0, angle, 0]))
    back = camera @ rotation @ np.linalg.inv(camera)
    expected = cv2.warpPerspective(
        image, back, SHAPE[::-1], flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP, borderValue=(0, 0, 0)
    )
    found = kernels.rectify_verged(image, angle, FOCAL, CENTER)
    inside = ndimage.binary_erosion((expected > 0).all(axis=2) & (found > 0).all(axis=2), iterations=2)
    assert inside.mean() > 0.5
    assert abs(found.astype(int) - expected)[inside].max() <= 2


@pytest.mark.parametrize("shift", [0.0, 26.0])
def test_disparity_stands_for_depth(kernels: Kernels, shift: float) -> None:
    """A wall seen by a pair verged by 5 degrees has the disparity f b / z - shift all over; of (8) alone its
    columns are as far apart as f tan(angle), and not evenly.
    """
    angle, wide = np.deg2rad(5), clouds(4, (200, 400))
    truth = 24.0  # f b / z
    y, x = np.indices(SHAPE).astype(np.float64)
    left = np.rint(wide[:, 60 : 60 + SHAPE[1]]).clip(0, 255).astype(np.uint8)
    cos, sin = np.cos(angle), np.sin(angle)
    ahead = FOCAL * cos + (x - CENTER[0]) * sin  # of the turned camera's rays, in the parallel one's frame
    at_x = CENTER[0] + FOCAL * ((x - CENTER[0]) * cos - FOCAL * sin) / ahead + truth
    at_y = CENTER[1] + FOCAL * (y - CENTER[1]) / ahead
    turned = ndimage.map_coordinates(wide, [at_y, at_x + 60], order=3, mode="nearest")
    right = np.rint(turned).clip(0, 255).astype(np.uint8)

    rectified = kernels.rectify_verged(right, float(angle), FOCAL, CENTER, shift)
    found, _ = kernels.gradient_disparity(left, rectified, truth - shift, GradientMatching())
    inner = found[20:-20, 40:-60]
    assert np.isfinite(inner).mean() > 0.9
    assert np.nanmedian(abs(inner - (truth - shift))) < 0.1
    straight = kernels.rectify_verged(right, float(angle), FOCAL, CENTER, rows_only=True)
    uneven, _ = kernels.gradient_disparity(left, straight, truth - FOCAL * np.tan(angle), GradientMatching())
    assert np.nanstd(uneven[20:-20, 40:-60]) > 4 * np.nanstd(inner)


def test_nothing_turned(kernels: Kernels) -> None:
    """Angle 0 leaves the image, with rows_only and without."""
    image = np.rint(clouds(5, (40, 50))).clip(0, 255).astype(np.uint8)
    for center in (None, (17.3, 20.7), (-1 / 3, 1e3 / 7)):
        for rows_only in (False, True):
            found = kernels.rectify_verged(image, 0.0, FOCAL, center, rows_only=rows_only)
            assert_array_equal(found, image)


def test_shift_moves_the_picture(kernels: Kernels) -> None:
    """Whole columns of shift move the result by as many, to the last bit."""
    image = np.rint(clouds(6, (40, 90))).clip(0, 255).astype(np.uint8)
    there, here = (kernels.rectify_verged(image, 0.1, FOCAL, shift=shift) for shift in (0.0, 17.0))
    assert_array_equal(here[:, 17:], there[:, :-17])


def test_black_where_nothing_was_seen(kernels: Kernels) -> None:
    """An even image stays even, and what isn't in it is black: the side that the camera turned away from."""
    image = np.full((60, 80), 200, np.uint8)
    found = kernels.rectify_verged(image, 0.3, 100.0)
    assert set(np.unique(found)) == {0, 200}
    assert (found[:, 0] == 200).any()
    assert (found[:, -1] == 0).all()
    assert (kernels.rectify_verged(image, 1.5, 10.0)[:, -1] == 0).all()  # behind the camera


BAD: list[tuple[dict[str, Any], str]] = [
    ({"right": np.zeros((0, 5), np.uint8)}, "right: expected at least one pixel, got none"),
    ({"angle": 1.6}, "angle: expected radians between -pi/2 and pi/2, got 1.6"),
    ({"angle": np.nan}, "angle: expected radians between -pi/2 and pi/2, got nan"),
    ({"focal": 0.0}, "focal: expected a finite number above 0, got 0"),
    ({"focal": np.inf}, "focal: expected a finite number above 0, got inf"),
    ({"center": (np.nan, 3.0)}, "center: expected finite numbers, got nan"),
    ({"center": (3.0, np.inf)}, "center: expected finite numbers, got inf"),
    ({"shift": np.inf}, "shift: expected a finite number, got inf"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    good = {"right": np.zeros((9, 9), np.uint8), "angle": 0.1, "focal": 10.0}
    with pytest.raises(ValueError, match=message):
        kernels.rectify_verged(**good | changes)


def test_native_refuses_other_images() -> None:
    """Floats, other channels, too many columns and pixels that aren't packed are named, never converted."""
    with pytest.raises(TypeError, match="right: expected a uint8 gray image"):
        _core.rectify_verged(np.zeros((9, 9), np.float32), 0.1, 10.0)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="right: expected a uint8 BGR image"):
        _core.rectify_verged(np.zeros((9, 9, 4), np.uint8), 0.1, 10.0)
    with pytest.raises(ValueError, match="right: expected at most 1048575 rows and columns"):
        _core.rectify_verged(np.zeros((1, 2**20), np.uint8), 0.1, 10.0)
    with pytest.raises(ValueError, match="right: expected packed pixels"):
        _core.rectify_verged(np.zeros((9, 9), np.uint8)[:, ::2], 0.1, 10.0)
