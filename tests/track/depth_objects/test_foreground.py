# SPDX-License-Identifier: MIT
"""The foreground of a depth image: what is in range and above the floor."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import DepthParticleTracker, Intrinsics
from tricue.track.depth_objects import foreground
from tricue.track.depth_objects.floor import NO_FLOOR, find_floor
from tricue.track.depth_objects.foreground import Foreground, extract_foreground

Params = DepthParticleTracker.Params
Depth = NDArray[np.float32]
CAMERA = Intrinsics.from_fov(176, 144, 47.5, 39.5)
HEIGHT, PITCH = 1.3, math.radians(12)  # meters over the floor; downwards
FLOOR = np.array([0.0, -math.cos(PITCH), -math.sin(PITCH), HEIGHT])
WALL = 6.0  # meters
POST = (slice(30, 120), slice(80, 96))


def heights(depth: Depth) -> NDArray[np.float64]:
    """Meters above the true floor of each pixel."""
    v, u = np.indices(depth.shape)
    return CAMERA.back_project(u, v, depth) @ FLOOR[:3] + FLOOR[3]


def hall(noise: float = 0.0, wall: float = WALL, post: float = 3.0) -> Depth:
    """A floor under a camera that looks down on it, a wall, and a post."""
    v, u = np.indices((144, 176))
    down = -(CAMERA.back_project(u, v, 1.0) @ FLOOR[:3])
    with np.errstate(divide="ignore"):
        depth = np.where(down > 0, HEIGHT / down, np.inf)
    depth = np.minimum(depth, wall)
    depth[POST] = np.minimum(depth[POST], post)
    depth[depth > 30] = np.nan
    return (depth + noise * np.random.default_rng(0).standard_normal(depth.shape)).astype(np.float32)


def found(kernels, depth: Depth, plane=NO_FLOOR, number=0, **parameters):
    """The foreground of a frame, and its floor."""
    return extract_foreground(kernels, depth, CAMERA.vector, plane, number, Params(**parameters))


@pytest.mark.parametrize("number", range(3))
def test_the_floor_is_found(number, kernels):
    """Of a floor alone the plane is the true one within float32's rounding; with 1 cm of noise and a wall,
    whose foot is fitted too, it is within 1 cm of height and a quarter of a degree, for any random numbers.
    """
    _, exact = found(kernels, hall(wall=np.inf, post=np.inf), number=number)
    np.testing.assert_allclose(exact[:4], FLOOR, atol=1e-5)
    _, noisy = found(kernels, hall(0.01), number=number)
    assert abs(noisy[3] - HEIGHT) < 0.01
    assert math.degrees(math.acos(min(1.0, noisy[:3] @ FLOOR[:3]))) < 0.25


def test_the_floor_is_removed(kernels):
    """Everything up to 12 cm above the floor is removed, nothing above that, whatever its distance."""
    depth = hall(wall=np.inf)
    depth[20:30, 60:70] = 4.0
    fg, _ = found(kernels, depth, far=1e6)
    over = heights(np.where(np.isfinite(depth), depth, np.nan))
    clear = ~(np.abs(over - 0.12) < 1e-3)  # the rest may fall either way
    np.testing.assert_array_equal(np.isfinite(fg.depth)[clear], (over > 0.12)[clear])
    assert np.isfinite(fg.depth[POST]).any()
    kept = np.isfinite(fg.depth)
    np.testing.assert_array_equal(fg.depth[kept], depth[kept])


@pytest.mark.parametrize("clear", [0.0, 0.05, 0.5])
def test_the_floor_is_removed_up_to_a_height(clear, kernels):
    """The floor is removed up to the height ``floor_clear``."""
    depth = hall()
    fg, _ = found(kernels, depth, floor_clear=clear)
    over = heights(depth)[np.isfinite(fg.depth)]
    assert over.min() > clear - 1e-3
    assert over.min() < clear + 0.05


def test_without_floor_it_stays(kernels):
    """With ``floor=False`` the floor belongs to the foreground, and no plane is searched."""
    fg, plane = found(kernels, hall(), floor=False)
    assert np.isfinite(fg.depth).all()
    assert not plane.any()


def test_a_wall_is_no_floor(kernels):
    """A wall right in front of the camera isn't taken for a floor: all of it stays."""
    fg, plane = found(kernels, np.full((144, 176), 2.0, np.float32))
    assert not plane.any()
    assert np.isfinite(fg.depth).all()


@pytest.mark.parametrize("noise", [0.003, 0.02])
@pytest.mark.parametrize("distance", [0.7, 1.5, 3.0])
def test_an_upright_target_alone_has_no_floor(distance, noise, kernels):
    """Where depth ends behind the target, its lower part isn't taken for a floor: all of it stays."""
    v, u = np.indices((144, 176))
    across, along = (CAMERA.back_project(u, v, 1.0)[..., axis] * distance for axis in (0, 1))
    bulge = 0.12 * np.sqrt(np.maximum(1 - (across / 0.2) ** 2, 0))
    depth = distance - bulge + noise * np.random.default_rng(0).standard_normal(u.shape)
    depth[(np.abs(across) > 0.2) | (np.abs(along) > 0.7)] = np.nan
    for number in range(5):
        fg, plane = found(kernels, depth.astype(np.float32), number=number)
        assert not plane.any()
        np.testing.assert_array_equal(np.isfinite(fg.depth), np.isfinite(depth))


@pytest.mark.parametrize(("columns", "is_floor"), [(6, False), (60, True)])
def test_a_small_patch_is_no_floor(columns, is_floor, kernels):
    """A patch of under 6 % of what is measured is no floor, though all of it is flat and nothing is below; a
    quarter is one.
    """
    depth = hall(wall=np.inf, post=np.inf)
    depth[:72] = 2.0
    depth[72:, columns:] = np.nan
    _, plane = found(kernels, depth)
    assert plane.any() == is_floor


@pytest.mark.parametrize("scale", [0.001, 0.005, 0.02])
def test_what_is_too_near_is_no_floor(scale, kernels):
    """A frame of depths that are nearer than any target, such as one in another unit, leaves no floor, and
    the known one stays.
    """
    near = hall(0.01) * np.float32(scale)
    assert not found(kernels, near)[1].any()
    _, plane = found(kernels, hall(0.01))
    np.testing.assert_array_equal(found(kernels, near, plane)[1], plane)


def test_a_floor_that_holds_is_kept(kernels):
    """While a known floor has its points, noise doesn't move it: it stays bit for bit, whatever the random
    numbers.
    """
    _, plane = found(kernels, hall(0.01))
    _, again = found(kernels, hall(0.005), plane, number=5)
    np.testing.assert_array_equal(again, plane)


@pytest.mark.parametrize(("share", "is_searched"), [(0.15, False), (0.25, True)])
def test_a_floor_is_searched_where_a_fifth_of_it_is_covered(share, is_searched, kernels, monkeypatch):
    """While a known floor has four fifths of its points no other is looked for; where it has fewer, as the
    camera may have moved, another is.
    """
    depth = hall()
    _, plane = found(kernels, depth)
    assert 0.3 < plane[4] < 0.7  # the wall and the post aren't on it
    depth[:, : int(share * depth.shape[1])] *= 0.5
    searched = []
    monkeypatch.setattr(foreground, "find_floor", lambda *given: searched.append(given) or find_floor(*given))
    found(kernels, depth, plane)
    assert bool(searched) == is_searched


def test_a_camera_that_moved_finds_its_floor_again(kernels):
    """A floor 0.4 m higher than the true one has few points, and gives way to the true one."""
    depth = hall(wall=np.inf, post=np.inf)
    _, plane = found(kernels, depth)
    moved = plane - [0, 0, 0, 0.4, 0, 0]
    np.testing.assert_allclose(found(kernels, depth, moved)[1][:4], FLOOR, atol=1e-5)


def test_a_known_floor_outlives_frames_without(kernels):
    """The floor is kept where a frame shows none: nothing measured, or somebody in front of everything."""
    _, plane = found(kernels, hall())
    for depth in (np.full((144, 176), np.nan, np.float32), np.full((144, 176), 0.6, np.float32)):
        _, kept = found(kernels, depth, plane)
        np.testing.assert_array_equal(kept, plane)


def test_a_floor_that_is_covered_stays(kernels):
    """Where half of the floor is covered the known one stays bit for bit, as no other has more points."""
    depth = hall(wall=np.inf, post=np.inf)
    _, plane = found(kernels, depth)
    depth[:, :80] *= 0.5
    np.testing.assert_array_equal(found(kernels, depth, plane)[1], plane)


@pytest.mark.parametrize(
    ("missing", "passes", "is_filled"), [(0.1, 3, True), (0.1, 0, False), (0.03, 3, False)]
)
def test_images_with_many_gaps_are_filled(missing, passes, is_filled, kernels):
    """Where more of an image is gaps than max_gap_share, 6 %, small ones get the depths around them."""
    depth = np.full((144, 176), 3.0, np.float32)
    gaps = np.random.default_rng(0).random(depth.shape) < missing
    depth[gaps] = np.nan
    fg, _ = found(kernels, depth, floor=False, gap_passes=passes)
    assert np.isfinite(fg.depth[gaps]).all() == is_filled
    assert np.isnan(fg.depth[gaps]).all() != is_filled
    np.testing.assert_allclose(fg.depth[np.isfinite(fg.depth)], 3.0, rtol=1e-6)


@pytest.mark.parametrize(("near", "far"), [(0.3, 8.0), (2.5, 4.0)])
def test_only_what_is_in_range_is_left(near, far, kernels):
    """Depths from near up to, but without, far are left, others are NaN."""
    depth = np.linspace(0.05, 10, 144 * 176, dtype=np.float32).reshape(144, 176)
    depth[0, :4] = np.float32([near, far, np.nan, (near + far) / 2])
    fg, _ = found(kernels, depth, floor=False, near=near, far=far)
    inside = (depth >= near) & (depth < far)
    np.testing.assert_array_equal(np.isfinite(fg.depth), inside)


@pytest.mark.parametrize(("resolution", "step"), [(320, 1), (176, 1), (88, 2), (59, 3), (16, 11)])
def test_wide_images_are_thinned(resolution, step, kernels):
    """An image wider than ``resolution`` is thinned to every step-th pixel, and its camera sees the same
    points: pixel (i, j) lies where (step i, step j) did.
    """
    depth = hall()
    fg, _ = found(kernels, depth, floor=False, resolution=resolution)
    assert fg.step == step
    np.testing.assert_array_equal(fg.depth, depth[::step, ::step])
    i, j = 5, 7
    fx, fy, cx, cy = fg.camera
    ray = [(j - cx) / fx, (i - cy) / fy]
    np.testing.assert_allclose(ray, CAMERA.back_project(step * j, step * i, 1.0)[:2], rtol=1e-12)


def test_a_thinned_image_has_the_same_floor(kernels):
    """The plane found in every other pixel is the floor of the whole image."""
    _, plane = found(kernels, hall(wall=np.inf, post=np.inf), resolution=88)
    np.testing.assert_allclose(plane[:4], FLOOR, atol=1e-5)


def test_the_frame_is_only_read(kernels):
    """The depth image given stays as it is, and the foreground is another array."""
    depth = hall()
    before = depth.copy()
    fg, _ = found(kernels, depth)
    assert isinstance(fg, Foreground)
    assert not np.shares_memory(fg.depth, depth)
    np.testing.assert_array_equal(depth, before)


@pytest.mark.parametrize("shape", [(1, 1), (1, 9), (9, 1), (2, 2), (3, 3)], ids=str)
def test_tiny_images_have_no_floor(shape, kernels):
    """Images of a few pixels have a foreground, and no floor."""
    fg, plane = found(kernels, np.full(shape, 2.0, np.float32))
    assert np.isfinite(fg.depth).all()
    assert not plane.any()
