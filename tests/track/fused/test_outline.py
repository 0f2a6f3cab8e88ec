# SPDX-License-Identifier: MIT
"""The sides of what stands at the target's depth, against depth images whose truth is known."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from tricue import FusedTracker, Intrinsics, StereoRig
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_sources import DepthImageSource, ExpectedDepth, StereoSource
from tricue.track.fused.experts.depth import covered_share
from tricue.track.fused.learn import _update_outline
from tricue.track.fused.outline import (
    BOX_OUTLINE,
    MAX_COVERED_BY_OCCLUDER,
    MAX_CUT_REACH,
    MAX_FIRST_DEVIATION,
    MAX_SEEN_DEVIATION,
    MIN_FILLED_POSTERIOR,
    Outline,
    Reaches,
    Side,
    Sides,
    _extent,
    measure_reaches,
)
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.support import SUPPORT_TOLERANCE
from tricue.track.fused.target import Target
from tricue.track.fused.window import Window, extract_window

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
ALL_SEEN = Sides(*4 * [Side.SEEN])


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
    observation = PictureObservation(
        kernel_sets.load("native"), color, CAMERA, source, ExpectedDepth(Z, 0.05)
    )
    return extract_window(observation, target, 3.0)


def reaches(
    window: Window, right: float = 0.0, down: float = 0.0, covered: float = 0.0, without_support: bool = False
) -> Reaches | None:
    """As of measure_reaches, by default from the window's center."""
    return measure_reaches(window, right, down, covered, without_support=without_support)


def edges(target: Target) -> np.ndarray:
    """Left, top, right and bottom of its box, pixels from CENTER."""
    box, (x, y) = target.box, CENTER
    return np.array([x - box.x, y - box.y, box.x + box.width - x, box.y + box.height - y])


@pytest.mark.parametrize("sides", SIDES, ids=str)
def test_sides_of_a_rectangle(sides):
    """Each side of a rectangle is found to half a patch pixel, wherever the other three are."""
    window = window_around(thing(sides))
    assert window.pixel_size == 3
    assert edges(Outline(*reaches(window)).apply_to(LARGE)) == pytest.approx(sides, abs=window.pixel_size / 2)


@pytest.mark.parametrize("sides", [(8, 14, 8, 14), (6, 11, 13, 19), (15, 20, 5, 9)], ids=str)
def test_sides_of_a_small_one(sides):
    """So are those of a target of a few pixels, whose box is higher than wide."""
    window = window_around(thing(sides), SMALL)
    assert window.pixel_size == pytest.approx(1, abs=0.01)
    assert edges(Outline(*reaches(window)).apply_to(SMALL)) == pytest.approx(sides, abs=window.pixel_size / 2)


@pytest.mark.parametrize("offset", [(4.0, -3.0), (-2.5, 5.0), (0.3, 0.6)], ids=str)
def test_sides_off_the_center(offset):
    """At a place off the window's center it gives the same sides, as distances from that place."""
    window, (right, down) = window_around(thing(SIDES[1])), offset
    there = LARGE.shift(window.pixel_size * right, window.pixel_size * down)
    assert edges(Outline(*reaches(window, right, down)).apply_to(there)) == pytest.approx(
        SIDES[1], abs=window.pixel_size / 2
    )


def test_noise_and_holes_move_no_side():
    """With noise of 1 cm, and a fifth of the pixels not measured, sides are found to a patch pixel."""
    depth = thing(SIDES[1]) + RNG.normal(0, 0.01, SHAPE).astype(np.float32)
    depth[RNG.random(SHAPE) < 0.2] = np.nan
    window = window_around(depth)
    assert edges(Outline(*reaches(window)).apply_to(LARGE)) == pytest.approx(SIDES[1], abs=window.pixel_size)


def test_sets_of_kernels_agree(kernels):
    """Native and reference kernels give the same sides to a thousandth of the box."""
    window = window_around(thing(SIDES[2]))
    observation = PictureObservation(
        kernels,
        window.observation.picture,
        CAMERA,
        window.observation.depth_source,
        window.observation.expected_depth,
    )
    found = reaches(extract_window(observation, LARGE, 3.0))
    assert found == pytest.approx(reaches(window), abs=1e-3)


@pytest.mark.parametrize("share", [0.0, MAX_COVERED_BY_OCCLUDER, MAX_COVERED_BY_OCCLUDER + 1e-6, 0.5, 1.0])
def test_a_covered_target_has_no_outline(share):
    """It is None exactly where an occluder covers more than MAX_COVERED_BY_OCCLUDER of the box."""
    assert (reaches(window_around(thing(SIDES[0])), covered=share) is None) == (
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
    assert reaches(window, covered=covered) is None
    assert reaches(window) is not None


@pytest.mark.parametrize("side", range(4))
def test_what_goes_on_has_no_end(side):
    """None where what stands at the target's depth reaches the window's edge; the other sides are found."""
    sides = [40.0, 40.0, 40.0, 40.0]
    sides[side] = 100.0  # the window's half is 96
    found = reaches(window_around(thing(tuple(sides))))
    assert found[side] is None
    others = [reach for number, reach in enumerate(found) if number != side]
    assert others == pytest.approx([40 / 32] * 3, abs=0.05)


NOWHERE = Reaches(None, None, None, None)


def test_nothing_there_has_no_sides():
    """None where its center isn't at its depth, so that there is nothing to follow outwards."""
    assert reaches(window_around(np.full(SHAPE, WALL, np.float32))) == NOWHERE
    assert reaches(window_around(thing(SIDES[0])), right=25.0)[::2] == (None, None)


def test_what_is_not_measured_is_no_side():
    """A target in front of nothing but unmeasured pixels has no sides."""
    assert reaches(window_around(thing(SIDES[0], wall=np.nan))) == NOWHERE
    assert reaches(window_around(np.full(SHAPE, np.nan, np.float32))) == NOWHERE


class Blurred(DepthImageSource):
    """The same depth, whose edges aren't those of the picture."""

    has_sharp_edges = False


def test_without_sharp_edges_there_is_none():
    """Color alone has no outline, nor has depth without sharp edges, as of a stereo pair."""
    depth = thing(SIDES[0])
    assert reaches(window_around(depth)) is not None
    assert reaches(window_around(depth, source=Blurred(depth))) is None
    assert reaches(window_around(None)) is None
    image = np.zeros((*SHAPE, 3), np.uint8)
    assert not StereoSource(image, image, StereoRig(CAMERA, 0.1)).has_sharp_edges


SLANT = 150.0  # pixels in which the table's inverse depth doubles


def table() -> np.ndarray:
    """A thing on a table, seen from above: its foot is 20 pixels below the middle, where the table is as far
    away as the thing; farther below it comes towards the camera.
    """
    x, y = map(int, CENTER)
    rows = np.arange(SHAPE[0])[:, None] - (y + 20)
    inverse = np.maximum(1 + rows / SLANT, 0.01) / Z  # of the depth: linear on a plane
    depth = np.broadcast_to(1 / inverse, SHAPE).astype(np.float32)
    depth[: y - 40] = WALL
    depth[y - 32 : y + 20, x - 32 : x + 32] = Z
    return depth


def test_what_it_stands_on_is_left_out():
    """Below, a table is as far away as the thing. Without the plane its lower side is found to a pixel of the
    window, but for the strip that is within the tolerance of the plane; the others as before.
    """
    window = window_around(table())
    blind, found = reaches(window), reaches(window, without_support=True)
    assert blind.bottom is None or blind.bottom > 20 / 32 + 0.2
    strip = SLANT * SUPPORT_TOLERANCE
    assert (20 - strip - window.pixel_size) / 32 <= found.bottom <= (20 + window.pixel_size) / 32
    assert (found.left, found.right) == pytest.approx((1, 1), abs=0.1)


def test_sides_at_the_border_are_cut():
    """Within a tenth of the target's side of the border, and beyond it."""
    assert Sides.cut_by_border(Target(100.0, 100.0, 40.0, 40.0), (200, 300)) == (Side.HIDDEN,) * 4
    assert Sides.cut_by_border(Target(23.9, 100.0, 40.0, 40.0), (200, 300))[0] is Side.CUT
    assert Sides.cut_by_border(Target(24.1, 100.0, 40.0, 40.0), (200, 300))[0] is Side.HIDDEN
    assert Sides.cut_by_border(Target(290.0, 195.0, 40.0, 40.0), (200, 300)) == (
        *(Side.HIDDEN, Side.HIDDEN),
        *(Side.CUT, Side.CUT),
    )


@pytest.mark.parametrize("deviation", [-MAX_FIRST_DEVIATION, 0.0, MAX_FIRST_DEVIATION])
def test_sides_are_seen_where_the_box_has_them(deviation):
    """Sides whose reach is the box's, give or take, are SEEN; others stay HIDDEN, cut ones CUT."""
    hidden = Sides(*[Side.HIDDEN] * 3, Side.CUT)
    far = 1.01 * deviation + np.sign(deviation or 1) * 0.01 + (0 if deviation else 1)
    seen = hidden.see(Reaches(1 + 0.99 * deviation, 1 + far, None, 1.0))
    assert seen == (Side.SEEN, Side.HIDDEN, Side.HIDDEN, Side.CUT)
    assert hidden.see(None) == hidden


def test_an_outline_has_the_sides_that_are_seen():
    """Hidden sides and those without a reach are the box's; seen ones follow unless they jump; cut ones only
    grow.
    """
    seen, cut, hidden = Side.SEEN, Side.CUT, Side.HIDDEN
    assert Sides(hidden, seen, cut, seen).outline(Reaches(1.3, 0.8, 2.5, None)) == (1, 0.8, 2.5, 1)
    jump = 1 + 1.01 * MAX_SEEN_DEVIATION
    assert Sides(seen, cut, cut, seen).outline(Reaches(jump, 0.5, 99.0, 1.1)) == (1, 1, MAX_CUT_REACH, 1.1)


def test_apply_to_by_hand():
    """A box of 20 by 10 whose sides are at 1/2, 1, 3/2 and 2 halves is 20 by 15, 5 to the right, 2.5 down."""
    target = Target(100.0, 50.0, 20.0, 10.0)
    assert Outline(0.5, 1.0, 1.5, 2.0).apply_to(target) == pytest.approx((105, 52.5, 20, 15, 0))
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


@pytest.mark.parametrize("rate", [9, 25, 60])
def test_the_outline_follows_by_its_time_constant(rate):
    """After one time constant it is 1 - 1/e of the way to what is measured, at any frame rate."""
    p = FusedTracker.Params(outline_time_constant=1.0)
    window = window_around(thing((40, 32, 32, 32)))
    reaches = measure_reaches(window, 0.0, 0.0, covered_share(window), without_support=False)
    state = SimpleNamespace(
        missed_frames=0, sides=ALL_SEEN, depth_object=None, outline=BOX_OUTLINE, seconds=1 / rate
    )
    state.replace = lambda outline: SimpleNamespace(**{**vars(state), "outline": outline})
    match = SimpleNamespace(candidate=SimpleNamespace(window=window, right=0.0, down=0.0))
    found = state
    for _ in range(rate):
        state.outline = found.outline
        found = _update_outline(state, match, p)
    assert reaches.left > 1.2
    assert found.outline.left - 1 == pytest.approx((1 - math.exp(-1)) * (reaches.left - 1))


def test_exactly_half_is_filled():
    """Pixels of which exactly half is the target's, in float32, go on to the side behind them."""
    half = np.float32(MIN_FILLED_POSTERIOR)
    profile = np.array([0, 0.9, 0.9, half, half, 0], np.float32)
    before, after = _extent(profile, 2.0, 1.0)
    assert before == pytest.approx(2 - (0.5 + MIN_FILLED_POSTERIOR / 0.9))
    assert after == pytest.approx(4.5 - 2)
