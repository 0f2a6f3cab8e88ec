# SPDX-License-Identifier: MIT
"""The target's depth as the fused tracker measures it, against depth images whose truth is known."""

import numpy as np
import pytest
from tricue import Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_sources import DepthImageSource, ExpectedDepth
from tricue.track.fused.experts.depth import (
    MAX_DEPTH_SPREAD,
    MIN_DEPTH_SPREAD,
    MIN_MEASURED_SHARE,
    DepthExpert,
    DepthMeasurement,
    measure_depth,
)
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.target import Target

CAMERA = Intrinsics.from_fov(200, 160, 60)
TARGET = Target(100.0, 80.0, 60.0, 60.0)
Z = 2.0
EXPECTED = {"unknown": None, "expected": ExpectedDepth(Z, 0.1), "vague": ExpectedDepth(5.0, 3.0)}


def observation(depth: np.ndarray | None) -> PictureObservation:
    """A frame with that depth."""
    source = None if depth is None else DepthImageSource(np.asarray(depth, np.float32))
    return PictureObservation(
        kernel_sets.load("native"), np.zeros((160, 200, 3), np.uint8), CAMERA, source, None
    )


def flat(z: float = Z) -> np.ndarray:
    """A plane that faces the camera."""
    return np.full((160, 200), z, np.float32)


def in_front_of_wall(z: float = Z, wall: float = 4.0) -> np.ndarray:
    """An ellipse as large as the target's box in front of a wall."""
    y, x = np.indices((160, 200)) + 0.5
    inside = ((x - TARGET.x) / TARGET.width) ** 2 + ((y - TARGET.y) / TARGET.height) ** 2 <= 0.25
    return np.where(inside, z, wall)


@pytest.mark.parametrize("known", EXPECTED)
def test_a_plane_is_measured_exactly(known):
    """A plane without noise is at its depth, all of it is measured, and it has no spread."""
    z, spread, share = measure_depth(observation(flat()), TARGET, EXPECTED[known])
    assert z == Z
    assert spread == 0
    assert share == 1


@pytest.mark.parametrize("known", EXPECTED)
def test_noise_is_measured(known):
    """The spread is the noise's standard deviation to 15 %, the median is right to 15 % of it."""
    noise = np.random.default_rng(0).normal(0, 0.03, (160, 200))
    z, spread, _ = measure_depth(observation(flat() + noise), TARGET, EXPECTED[known])
    assert z == pytest.approx(Z, abs=0.15 * 0.03)
    assert spread == pytest.approx(0.03, rel=0.15)


def test_a_slanted_plane():
    """A plane that recedes to the right is at the depth of the target's center; its spread is that of an even
    distribution over the part that counts.
    """
    x = np.indices((160, 200))[1] + 0.5
    slope = 0.004  # meters per pixel
    z, spread, share = measure_depth(observation(Z + slope * (x - TARGET.x)), TARGET, None)
    assert z == pytest.approx(Z, abs=2 * slope)
    assert share == 1
    half = 0.25 * TARGET.width * slope  # of the inner half of the box
    assert spread == pytest.approx(1.4826 * half / 2, rel=0.15)


@pytest.mark.parametrize("known", EXPECTED)
@pytest.mark.parametrize("holes", [0.2, 0.5, 0.8])
def test_holes_are_left_out(holes, known):
    """With up to four fifths of the pixels missing it is still right; share is that of the pixels that were
    measured, where a depth is expected.
    """
    depth = flat()
    depth[np.random.default_rng(0).random(depth.shape) < holes] = np.nan
    z, _, share = measure_depth(observation(depth), TARGET, EXPECTED[known])
    assert z == Z
    if known == "expected":
        assert share == pytest.approx(1 - holes, abs=0.07)


@pytest.mark.parametrize("known", ["unknown", "expected"])
@pytest.mark.parametrize("wall", [2.8, 4.0, np.nan])
def test_the_background_is_left_out(wall, known):
    """An ellipse in front of a wall is measured, not the wall in the box's corners."""
    z, spread, _ = measure_depth(observation(in_front_of_wall(wall=wall)), TARGET, EXPECTED[known])
    assert z == Z
    assert spread == 0


@pytest.mark.parametrize(("width", "height"), [(6, 120), (120, 6), (8, 130)])
def test_a_thin_target_is_measured(width, height):
    """A pole in front of a wall is measured, not the wall beside it."""
    y, x = np.indices((160, 200)) + 0.5
    inside = (abs(x - TARGET.x) < width / 2) & (abs(y - TARGET.y) < height / 2)
    z, spread, _ = measure_depth(observation(np.where(inside, Z, 4.0)), Target(100, 80, width, height), None)
    assert z == Z
    assert spread == 0


@pytest.mark.parametrize("x", [-12.0, -18.0])
def test_the_visible_part_is_measured(x):
    """Of a target that is mostly outside of the image, what is inside is measured, not the wall beside it."""
    columns = np.indices((160, 200))[1] + 0.5
    for seen, target in ((columns < x + 20, x), (columns > 180 - x, 200 - x)):
        z, spread, _ = measure_depth(observation(np.where(seen, Z, 4.0)), Target(target, 80, 40, 60), None)
        assert z == Z
        assert spread == 0


def test_what_is_expected_is_found_beside_more_of_something_else():
    """A third of the target that is visible beside an occluder, which covers its center, is measured."""
    depth = flat()
    depth[:, 85:160] = 1.2
    assert measure_depth(observation(depth), TARGET, ExpectedDepth(Z, 0.1)).z == Z
    assert measure_depth(observation(depth), TARGET, None).z == pytest.approx(1.2)


@pytest.mark.parametrize("hidden", [1.2, 3.0, np.nan])
def test_an_occluded_target_is_not_measured(hidden):
    """Where nothing in the box is at the depth expected there is no measurement."""
    assert measure_depth(observation(flat(hidden)), TARGET, ExpectedDepth(Z, 0.1)) is None


@pytest.mark.parametrize("known", EXPECTED)
def test_nothing_measured_is_none(known):
    """No depth, or none in the box, or a box outside the image, is None."""
    assert measure_depth(observation(None), TARGET, EXPECTED[known]) is None
    assert measure_depth(observation(flat(np.nan)), TARGET, EXPECTED[known]) is None
    assert measure_depth(observation(flat()), TARGET._replace(x=-500.0), EXPECTED[known]) is None


def test_too_little_is_none():
    """Where a depth is expected, MIN_MEASURED_SHARE of the box has to be measured."""
    few = np.random.default_rng(0).random((160, 200))
    assert (
        measure_depth(
            observation(np.where(few < 0.5 * MIN_MEASURED_SHARE, Z, np.nan)), TARGET, ExpectedDepth(Z, 0.1)
        )
        is None
    )
    assert (
        measure_depth(
            observation(np.where(few < 2 * MIN_MEASURED_SHARE, Z, np.nan)), TARGET, ExpectedDepth(Z, 0.1)
        )
        is not None
    )


@pytest.mark.parametrize("length", [0.1, 0.5, 2.0])
def test_lengths_are_learned_by_factors(length):
    """At rate 1 what was measured is taken over, at rate 0 nothing; half is the geometric mean."""
    expert, measured = DepthExpert(0.2, 0.4), DepthMeasurement(Z, 0.1, 1.0)
    assert expert.learn(measured, length, 1.0) == pytest.approx((0.1, length))
    assert expert.learn(measured, length, 0.0) == pytest.approx(expert)
    assert expert.learn(measured, length, 0.5) == pytest.approx((0.15, np.sqrt(0.4 * length)))


def test_depth_spread_stays_in_its_range():
    """A surface without spread, or with a huge one, is learned with the smallest and the largest one."""
    expert = DepthExpert(0.2, 0.4)
    assert expert.learn(DepthMeasurement(Z, 0.0, 1.0), 0.4, 1.0).depth_spread == pytest.approx(
        MIN_DEPTH_SPREAD
    )
    assert expert.learn(DepthMeasurement(Z, 9.0, 1.0), 0.4, 1.0).depth_spread == pytest.approx(
        MAX_DEPTH_SPREAD
    )
