# SPDX-License-Identifier: MIT
"""The sides of what stands at the target's depth, against depth images whose truth is known."""

import numpy as np
import pytest
from tricue import Intrinsics, StereoRig
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_sources import DepthImage, Pair
from tricue.track.fused.examine import hidden
from tricue.track.fused.outline import COVERED, LEAST, MOST, WHOLE, Outline, outline
from tricue.track.fused.sight import Expected, Sight
from tricue.track.fused.view import Target, View, look

SHAPE = (300, 400)
CAMERA = Intrinsics.from_fov(400, 300, 60)
Z, WALL, NEAR = 2.0, 4.0, 1.0
MIDDLE = (200.0, 150.0)
LARGE, SMALL = Target(*MIDDLE, 64.0, 64.0), Target(*MIDDLE, 16.0, 28.4)  # 3 and about 1 pixels a patch pixel
SIDES = [  # left, top, right and bottom, pixels from the middle
    (32, 32, 32, 32),
    (20, 32, 41, 29),
    (45, 51, 22, 30),
    (33, 34, 35, 37),
    (60, 20, 70, 80),
]
RNG = np.random.default_rng(0)


def thing(sides: tuple[float, ...], z: float = Z, wall: float = WALL) -> np.ndarray:
    """A depth image of a rectangle with these sides before a wall."""
    left, top, right, bottom = sides
    depth = np.full(SHAPE, wall, np.float32)
    x, y = map(int, MIDDLE)
    depth[y - int(top) : y + int(bottom), x - int(left) : x + int(right)] = z
    return depth


def seen(depth: np.ndarray | None, target: Target = LARGE, ranger: object = None) -> View:
    """The window round a target, by one who expects it at Z."""
    color = np.zeros((*SHAPE, 3), np.uint8)
    ranger = DepthImage(depth) if ranger is None and depth is not None else ranger
    sight = Sight(kernel_sets.load("native"), color, "color", CAMERA, ranger, Expected(Z, 0.05))
    return look(sight, [target], 3.0)[0]


def edges(target: Target) -> np.ndarray:
    """Left, top, right and bottom of its box, pixels from MIDDLE."""
    box, (x, y) = target.box, MIDDLE
    return np.array([x - box.x, y - box.y, box.x + box.width - x, box.y + box.height - y])


@pytest.mark.parametrize("sides", SIDES, ids=str)
def test_sides_are_where_they_are(sides):
    """Each side of a rectangle is found to half a patch pixel, wherever the other three are."""
    view = seen(thing(sides))
    assert view.unit == 3
    assert edges(outline(view, 0.0, 0.0, 0.0).around(LARGE)) == pytest.approx(sides, abs=view.unit / 2)


@pytest.mark.parametrize("sides", [(8, 14, 8, 14), (6, 11, 13, 19), (15, 20, 5, 9)], ids=str)
def test_sides_of_a_small_one(sides):
    """So are those of a target of a few pixels, whose box is higher than wide."""
    view = seen(thing(sides), SMALL)
    assert view.unit == pytest.approx(1, abs=0.01)
    assert edges(outline(view, 0.0, 0.0, 0.0).around(SMALL)) == pytest.approx(sides, abs=view.unit / 2)


@pytest.mark.parametrize("offset", [(4.0, -3.0), (-2.5, 5.0), (0.3, 0.6)], ids=str)
def test_sides_off_the_middle(offset):
    """Asked for a place off the view's middle it tells the same sides, as distances from that place."""
    view, (right, down) = seen(thing(SIDES[1])), offset
    there = LARGE.moved(view.unit * right, view.unit * down)
    assert edges(outline(view, right, down, 0.0).around(there)) == pytest.approx(SIDES[1], abs=view.unit / 2)


def test_noise_and_holes_move_no_side():
    """With noise of 1 cm, and a fifth of the pixels not measured, sides are found to a patch pixel."""
    depth = thing(SIDES[1]) + RNG.normal(0, 0.01, SHAPE).astype(np.float32)
    depth[RNG.random(SHAPE) < 0.2] = np.nan
    view = seen(depth)
    assert edges(outline(view, 0.0, 0.0, 0.0).around(LARGE)) == pytest.approx(SIDES[1], abs=view.unit)


def test_sets_of_kernels_agree(kernels):
    """Native and reference kernels tell the same sides to a thousandth of the box."""
    view = seen(thing(SIDES[2]))
    sight = Sight(kernels, view.sight.picture, "color", CAMERA, view.sight.ranger, view.sight.expected)
    found = outline(look(sight, [LARGE], 3.0)[0], 0.0, 0.0, 0.0)
    assert found == pytest.approx(outline(view, 0.0, 0.0, 0.0), abs=1e-3)


@pytest.mark.parametrize("share", [0.0, COVERED, COVERED + 1e-6, 0.5, 1.0])
def test_what_is_covered_has_no_outline(share):
    """It is None once something nearer hides more than COVERED of the box, and only then."""
    assert (outline(seen(thing(SIDES[0])), 0.0, 0.0, share) is None) == (share > COVERED)


@pytest.mark.parametrize("side", range(4))
def test_a_part_that_is_hidden_is_no_side(side):
    """What comes before the target from any side, and covers an eighth of it, is told as hidden, so that its
    edge isn't taken for the target's.
    """
    depth = thing(SIDES[0])
    band = np.rot90(depth, side)  # the same picture, turned
    middle, half = band.shape[1] // 2, 32
    band[:, : middle - half + 16] = NEAR
    view = seen(depth)
    covered = hidden(view)
    assert covered > COVERED
    assert outline(view, 0.0, 0.0, covered) is None
    assert outline(view, 0.0, 0.0, 0.0) is not None


@pytest.mark.parametrize("side", range(4))
def test_what_goes_on_has_no_outline(side):
    """None where what stands at the target's depth reaches the window's edge, by any one side."""
    sides = [40.0, 40.0, 40.0, 40.0]
    assert outline(seen(thing(tuple(sides))), 0.0, 0.0, 0.0) is not None
    sides[side] = 100.0  # the window's half is 96
    assert outline(seen(thing(tuple(sides))), 0.0, 0.0, 0.0) is None


def test_nothing_there_has_no_outline():
    """None where its middle isn't at its depth, so that there is nothing to follow outwards."""
    assert outline(seen(np.full(SHAPE, WALL, np.float32)), 0.0, 0.0, 0.0) is None
    assert outline(seen(thing(SIDES[0])), 25.0, 0.0, 0.0) is None


def test_what_is_not_measured_is_no_side():
    """Unmeasured pixels say neither: a target in front of nothing but holes has no outline."""
    assert outline(seen(thing(SIDES[0], wall=np.nan)), 0.0, 0.0, 0.0) is None
    assert outline(seen(np.full(SHAPE, np.nan, np.float32)), 0.0, 0.0, 0.0) is None


class Blunt(DepthImage):
    """The same depth, by something whose edges aren't where they are in the picture."""

    sharp = False


def test_without_sharp_depth_there_is_none():
    """Color alone has no outline, nor has depth that isn't sharp, as a pair's isn't."""
    depth = thing(SIDES[0])
    assert outline(seen(depth), 0.0, 0.0, 0.0) is not None
    assert outline(seen(depth, ranger=Blunt(depth)), 0.0, 0.0, 0.0) is None
    assert outline(seen(None), 0.0, 0.0, 0.0) is None
    image = np.zeros((*SHAPE, 3), np.uint8)
    assert not Pair(kernel_sets.load("native"), image, image, StereoRig(CAMERA, 0.1)).sharp


def test_sides_stay_in_their_range():
    """A side next to the middle is LEAST, one far away MOST, in halves of the box."""
    found = outline(seen(thing((4, 32, 50, 32))), 0.0, 0.0, 0.0)
    assert found.left == LEAST
    narrow = Target(*MIDDLE, 32.0, 128.0)
    found = outline(seen(thing((80, 60, 16, 60)), narrow), 0.0, 0.0, 0.0)
    assert found.left == MOST
    assert found.right == pytest.approx(1, abs=0.1)


def test_around_by_hand():
    """A box of 20 by 10 whose sides are at 1/2, 1, 3/2 and 2 halves is 20 by 15, 5 to the right, 2.5 down."""
    target = Target(100.0, 50.0, 20.0, 10.0)
    assert Outline(0.5, 1.0, 1.5, 2.0).around(target) == pytest.approx((105, 52.5, 20, 15))
    assert Outline(0.5, 1.0, 1.5, 2.0).around(target).box == pytest.approx((95, 45, 20, 15))


def test_whole_is_the_box():
    """Before any outline was seen the box is the target's own."""
    assert WHOLE.around(LARGE) == LARGE


@pytest.mark.parametrize("rate", [0.0, 0.25, 1.0])
def test_outlines_are_blended(rate):
    """Each side moves that share of the way to what was seen."""
    old, new = Outline(1.0, 0.8, 1.2, 1.0), Outline(0.5, 1.0, 2.0, 1.0)
    expected = [(1 - rate) * a + rate * b for a, b in zip(old, new, strict=True)]
    assert old.moved(new, rate) == pytest.approx(expected)
    assert isinstance(old.moved(new, rate), Outline)
