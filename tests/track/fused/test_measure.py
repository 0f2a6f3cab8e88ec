# SPDX-License-Identifier: MIT
"""The target's depth as the fused tracker measures it, against depth images whose truth is known."""

import numpy as np
import pytest
from tricue import Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_sources import DepthImage
from tricue.track.fused.experts.depth import LEAST, NARROW, WIDE, DepthExpert, Measured, measure
from tricue.track.fused.sight import Expected, Sight
from tricue.track.fused.view import Target

CAMERA = Intrinsics.from_fov(200, 160, 60)
TARGET = Target(100.0, 80.0, 60.0, 60.0)
Z = 2.0
EXPECTED = {"unknown": None, "expected": Expected(Z, 0.1), "unsure": Expected(5.0, 3.0)}


def sight(depth: np.ndarray | None) -> Sight:
    """A frame with that depth."""
    ranger = None if depth is None else DepthImage(np.asarray(depth, np.float32))
    return Sight(kernel_sets.load("native"), np.zeros((160, 200, 3), np.uint8), "color", CAMERA, ranger, None)


def flat(z: float = Z) -> np.ndarray:
    """A plane that faces the camera."""
    return np.full((160, 200), z, np.float32)


def before_wall(z: float = Z, wall: float = 4.0) -> np.ndarray:
    """An ellipse as large as the target's box before a wall."""
    y, x = np.indices((160, 200)) + 0.5
    inside = ((x - TARGET.x) / TARGET.width) ** 2 + ((y - TARGET.y) / TARGET.height) ** 2 <= 0.25
    return np.where(inside, z, wall)


@pytest.mark.parametrize("known", EXPECTED)
def test_a_plane_is_measured_exactly(known):
    """A plane without noise is at its depth, all of it is measured, and it has no spread."""
    z, spread, share = measure(sight(flat()), TARGET, EXPECTED[known])
    assert z == Z
    assert spread == 0
    assert share == 1


@pytest.mark.parametrize("known", EXPECTED)
def test_noise_is_measured(known):
    """The spread is the noise's standard deviation to 15 %, the median is right to 15 % of it."""
    noise = np.random.default_rng(0).normal(0, 0.03, (160, 200))
    z, spread, _ = measure(sight(flat() + noise), TARGET, EXPECTED[known])
    assert z == pytest.approx(Z, abs=0.15 * 0.03)
    assert spread == pytest.approx(0.03, rel=0.15)


def test_a_slanted_plane():
    """A plane that recedes to the right is at the depth of the target's middle; its spread is that of an even
    distribution over the part that counts.
    """
    x = np.indices((160, 200))[1] + 0.5
    slope = 0.004  # metres a pixel
    z, spread, share = measure(sight(Z + slope * (x - TARGET.x)), TARGET, None)
    assert z == pytest.approx(Z, abs=2 * slope)
    assert share == 1
    half = 0.25 * TARGET.width * slope  # of the inner half of the box
    assert spread == pytest.approx(1.4826 * half / 2, rel=0.15)


@pytest.mark.parametrize("known", EXPECTED)
@pytest.mark.parametrize("holes", [0.2, 0.5, 0.8])
def test_holes_are_left_out(holes, known):
    """With up to four fifths of the pixels missing it is right still; share says what was measured, of a
    target that is expected.
    """
    depth = flat()
    depth[np.random.default_rng(0).random(depth.shape) < holes] = np.nan
    z, _, share = measure(sight(depth), TARGET, EXPECTED[known])
    assert z == Z
    if known == "expected":
        assert share == pytest.approx(1 - holes, abs=0.07)


@pytest.mark.parametrize("known", ["unknown", "expected"])
@pytest.mark.parametrize("wall", [2.8, 4.0, np.nan])
def test_the_background_is_left_out(wall, known):
    """An ellipse before a wall is measured, not the wall in the box's corners."""
    z, spread, _ = measure(sight(before_wall(wall=wall)), TARGET, EXPECTED[known])
    assert z == Z
    assert spread == 0


def test_what_is_expected_is_found_beside_more_of_something_else():
    """A third of the target that looks out beside something nearer, which covers the middle, is measured."""
    depth = flat()
    depth[:, 85:160] = 1.2
    assert measure(sight(depth), TARGET, Expected(Z, 0.1)).z == Z
    assert measure(sight(depth), TARGET, None).z == pytest.approx(1.2)


@pytest.mark.parametrize("hidden", [1.2, 3.0, np.nan])
def test_what_is_hidden_is_not_measured(hidden):
    """Where nothing in the box is at the depth expected there is no measurement."""
    assert measure(sight(flat(hidden)), TARGET, Expected(Z, 0.1)) is None


@pytest.mark.parametrize("known", EXPECTED)
def test_nothing_measured_is_none(known):
    """No depth, or none in the box, or less than LEAST of it, or a box outside the image, is None."""
    assert measure(sight(None), TARGET, EXPECTED[known]) is None
    assert measure(sight(flat(np.nan)), TARGET, EXPECTED[known]) is None
    assert measure(sight(flat()), TARGET._replace(x=-500.0), EXPECTED[known]) is None


def test_too_little_is_none():
    """Of a target that is expected LEAST has to be measured."""
    few = np.random.default_rng(0).random((160, 200))
    assert measure(sight(np.where(few < 0.5 * LEAST, Z, np.nan)), TARGET, Expected(Z, 0.1)) is None
    assert measure(sight(np.where(few < 2 * LEAST, Z, np.nan)), TARGET, Expected(Z, 0.1)) is not None


@pytest.mark.parametrize("length", [0.1, 0.5, 2.0])
def test_lengths_are_learnt_by_factors(length):
    """At rate 1 what was measured is taken over, at rate 0 nothing; half is the geometric mean."""
    expert, measured = DepthExpert(0.2, 0.4), Measured(Z, 0.1, 1.0)
    assert expert.learnt(measured, length, 1.0) == pytest.approx((0.1, length))
    assert expert.learnt(measured, length, 0.0) == pytest.approx(expert)
    assert expert.learnt(measured, length, 0.5) == pytest.approx((0.15, np.sqrt(0.4 * length)))


def test_relief_stays_in_its_range():
    """A surface without spread, or with a huge one, is learnt as the least and the largest relief."""
    expert = DepthExpert(0.2, 0.4)
    assert expert.learnt(Measured(Z, 0.0, 1.0), 0.4, 1.0).relief == pytest.approx(NARROW)
    assert expert.learnt(Measured(Z, 9.0, 1.0), 0.4, 1.0).relief == pytest.approx(WIDE)
