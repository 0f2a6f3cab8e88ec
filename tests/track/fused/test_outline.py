# SPDX-License-Identifier: MIT
"""The sides of what stands at the target's depth, against depth images whose truth is known."""

import numpy as np
import pytest
from tricue import Intrinsics, StereoRig
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_sources import DepthImageSource, ExpectedDepth, StereoSource
from tricue.track.fused.experts.depth import covered_share
from tricue.track.fused.outline import (
    BOX_OUTLINE,
    MAX_COVERED_BY_OCCLUDER,
    MAX_OUTLINE_SIDE,
    MIN_OUTLINE_SIDE,
    Outline,
    measure_outline,
)
from tricue.track.fused.target import Target
from tricue.track.fused.target_observation import TargetObservation
from tricue.track.fused.window import Window, extract_windows

SHAPE = (300, 400)
CAMERA = Intrinsics.from_fov(400, 300, 60)
Z, WALL, NEAR = 2.0, 4.0, 1.0
CENTER = (200.0, 150.0)
LARGE, SMALL = Target(*CENTER, 64.0, 64.0), Target(*CENTER, 16.0, 28.4)  # 3 and about 1 pixels a patch pixel
SIDES = [  # left, top, right and bottom, pixels from the center
    (32, 32, 32, 32),
    (20, 32, 41, 29),
    (45, 51, 22, 30),
    (33, 34, 35, 37),
    (60, 20, 70, 80),
]
RNG = np.random.default_rng(0)


def thing(sides: tuple[float, ...], z: float = Z, wall: float = WALL) -> np.ndarray:
    """A depth image of a rectangle with these sides in front of a wall."""
    left, top, right, bottom = sides
    depth = np.full(SHAPE, wall, np.float32)
    x, y = map(int, CENTER)
    depth[y - int(top) : y + int(bottom), x - int(left) : x + int(right)] = z
    return depth


def window_around(depth: np.ndarray | None, target: Target = LARGE, source: object = None) -> Window:
    """The window around a target that is expected at Z."""
    color = np.zeros((*SHAPE, 3), np.uint8)
    source = DepthImageSource(depth) if source is None and depth is not None else source
    observation = TargetObservation(
        kernel_sets.load("native"), color, "color", CAMERA, source, ExpectedDepth(Z, 0.05)
    )
    return extract_windows(observation, [target], 3.0)[0]


def edges(target: Target) -> np.ndarray:
    """Left, top, right and bottom of its box, pixels from CENTER."""
    box, (x, y) = target.box, CENTER
    return np.array([x - box.x, y - box.y, box.x + box.width - x, box.y + box.height - y])


@pytest.mark.parametrize("sides", SIDES, ids=str)
def test_sides_of_a_rectangle(sides):
    """Each side of a rectangle is found to half a patch pixel, wherever the other three are."""
    window = window_around(thing(sides))
    assert window.pixel_size == 3
    assert edges(measure_outline(window, 0.0, 0.0, 0.0).apply_to(LARGE)) == pytest.approx(
        sides, abs=window.pixel_size / 2
    )


@pytest.mark.parametrize("sides", [(8, 14, 8, 14), (6, 11, 13, 19), (15, 20, 5, 9)], ids=str)
def test_sides_of_a_small_one(sides):
    """So are those of a target of a few pixels, whose box is higher than wide."""
    window = window_around(thing(sides), SMALL)
    assert window.pixel_size == pytest.approx(1, abs=0.01)
    assert edges(measure_outline(window, 0.0, 0.0, 0.0).apply_to(SMALL)) == pytest.approx(
        sides, abs=window.pixel_size / 2
    )


@pytest.mark.parametrize("offset", [(4.0, -3.0), (-2.5, 5.0), (0.3, 0.6)], ids=str)
def test_sides_off_the_center(offset):
    """At a place off the window's center it gives the same sides, as distances from that place."""
    window, (right, down) = window_around(thing(SIDES[1])), offset
    there = LARGE.shift(window.pixel_size * right, window.pixel_size * down)
    assert edges(measure_outline(window, right, down, 0.0).apply_to(there)) == pytest.approx(
        SIDES[1], abs=window.pixel_size / 2
    )


def test_noise_and_holes_move_no_side():
    """With noise of 1 cm, and a fifth of the pixels not measured, sides are found to a patch pixel."""
    depth = thing(SIDES[1]) + RNG.normal(0, 0.01, SHAPE).astype(np.float32)
    depth[RNG.random(SHAPE) < 0.2] = np.nan
    window = window_around(depth)
    assert edges(measure_outline(window, 0.0, 0.0, 0.0).apply_to(LARGE)) == pytest.approx(
        SIDES[1], abs=window.pixel_size
    )


def test_sets_of_kernels_agree(kernels):
    """Native and reference kernels give the same sides to a thousandth of the box."""
    window = window_around(thing(SIDES[2]))
    observation = TargetObservation(
        kernels,
        window.observation.picture,
        "color",
        CAMERA,
        window.observation.depth_source,
        window.observation.expected_depth,
    )
    found = measure_outline(extract_windows(observation, [LARGE], 3.0)[0], 0.0, 0.0, 0.0)
    assert found == pytest.approx(measure_outline(window, 0.0, 0.0, 0.0), abs=1e-3)


@pytest.mark.parametrize("share", [0.0, MAX_COVERED_BY_OCCLUDER, MAX_COVERED_BY_OCCLUDER + 1e-6, 0.5, 1.0])
def test_a_covered_target_has_no_outline(share):
    """It is None exactly where an occluder covers more than MAX_COVERED_BY_OCCLUDER of the box."""
    assert (measure_outline(window_around(thing(SIDES[0])), 0.0, 0.0, share) is None) == (
        share > MAX_COVERED_BY_OCCLUDER
    )


@pytest.mark.parametrize("side", range(4))
def test_an_occluders_edge_is_no_side(side):
    """An occluder that covers an eighth of the target from any side counts as covering it, so that its edge
    isn't taken for the target's.
    """
    depth = thing(SIDES[0])
    band = np.rot90(depth, side)  # the same picture, turned
    middle, half = band.shape[1] // 2, 32
    band[:, : middle - half + 16] = NEAR
    window = window_around(depth)
    covered = covered_share(window)
    assert covered > MAX_COVERED_BY_OCCLUDER
    assert measure_outline(window, 0.0, 0.0, covered) is None
    assert measure_outline(window, 0.0, 0.0, 0.0) is not None


@pytest.mark.parametrize("side", range(4))
def test_what_goes_on_has_no_outline(side):
    """None where what stands at the target's depth reaches the window's edge, by any one side."""
    sides = [40.0, 40.0, 40.0, 40.0]
    assert measure_outline(window_around(thing(tuple(sides))), 0.0, 0.0, 0.0) is not None
    sides[side] = 100.0  # the window's half is 96
    assert measure_outline(window_around(thing(tuple(sides))), 0.0, 0.0, 0.0) is None


def test_nothing_there_has_no_outline():
    """None where its center isn't at its depth, so that there is nothing to follow outwards."""
    assert measure_outline(window_around(np.full(SHAPE, WALL, np.float32)), 0.0, 0.0, 0.0) is None
    assert measure_outline(window_around(thing(SIDES[0])), 25.0, 0.0, 0.0) is None


def test_what_is_not_measured_is_no_side():
    """A target in front of nothing but unmeasured pixels has no outline."""
    assert measure_outline(window_around(thing(SIDES[0], wall=np.nan)), 0.0, 0.0, 0.0) is None
    assert measure_outline(window_around(np.full(SHAPE, np.nan, np.float32)), 0.0, 0.0, 0.0) is None


class Blurred(DepthImageSource):
    """The same depth, whose edges aren't those of the picture."""

    has_sharp_edges = False


def test_without_sharp_edges_there_is_none():
    """Color alone has no outline, nor has depth without sharp edges, as of a stereo pair."""
    depth = thing(SIDES[0])
    assert measure_outline(window_around(depth), 0.0, 0.0, 0.0) is not None
    assert measure_outline(window_around(depth, source=Blurred(depth)), 0.0, 0.0, 0.0) is None
    assert measure_outline(window_around(None), 0.0, 0.0, 0.0) is None
    image = np.zeros((*SHAPE, 3), np.uint8)
    assert not StereoSource(kernel_sets.load("native"), image, image, StereoRig(CAMERA, 0.1)).has_sharp_edges


def test_sides_stay_in_their_range():
    """A side next to the center is MIN_OUTLINE_SIDE, one far away MAX_OUTLINE_SIDE, in halves of the box."""
    found = measure_outline(window_around(thing((4, 32, 50, 32))), 0.0, 0.0, 0.0)
    assert found.left == MIN_OUTLINE_SIDE
    narrow = Target(*CENTER, 32.0, 128.0)
    found = measure_outline(window_around(thing((80, 60, 16, 60)), narrow), 0.0, 0.0, 0.0)
    assert found.left == MAX_OUTLINE_SIDE
    assert found.right == pytest.approx(1, abs=0.1)


def test_apply_to_by_hand():
    """A box of 20 by 10 whose sides are at 1/2, 1, 3/2 and 2 halves is 20 by 15, 5 to the right, 2.5 down."""
    target = Target(100.0, 50.0, 20.0, 10.0)
    assert Outline(0.5, 1.0, 1.5, 2.0).apply_to(target) == pytest.approx((105, 52.5, 20, 15))
    assert Outline(0.5, 1.0, 1.5, 2.0).apply_to(target).box == pytest.approx((95, 45, 20, 15))


def test_without_outline_it_is_the_box():
    """Before any outline was measured the box is the target's own."""
    assert BOX_OUTLINE.apply_to(LARGE) == LARGE


@pytest.mark.parametrize("rate", [0.0, 0.25, 1.0])
def test_outlines_are_blended(rate):
    """Each side moves that share of the way to the measured one."""
    old, new = Outline(1.0, 0.8, 1.2, 1.0), Outline(0.5, 1.0, 2.0, 1.0)
    expected = [(1 - rate) * a + rate * b for a, b in zip(old, new, strict=True)]
    assert old.blend(new, rate) == pytest.approx(expected)
    assert isinstance(old.blend(new, rate), Outline)
