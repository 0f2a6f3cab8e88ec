# SPDX-License-Identifier: MIT
"""The walker in falling light: its truth, its light, and that only the sensors feel it."""

import numpy as np
import pytest
from tricue.scenes import LIGHT_COURSES, lit_walker
from tricue.scenes.people.lit_walker import BRIGHTEST, FARTHEST, NEAREST, light_levels

FRAMES = 6


@pytest.fixture(scope="module")
def indoors():
    """A few frames under constant light."""
    return lit_walker(2, FRAMES)


def test_same_seed_same_bits(indoors):
    """The same arguments give the same frames and truth; another seed gives others."""
    again, other = lit_walker(2, FRAMES), lit_walker(3, FRAMES)
    for one, two in zip(indoors.frames, again.frames, strict=True):
        np.testing.assert_array_equal(one.color, two.color)
        np.testing.assert_array_equal(one.depth, two.depth)
    assert indoors.boxes == again.boxes != other.boxes


def test_color_and_depth_are_of_one_view(indoors):
    """Both have 176x144 pixels, and a time that grows by a fifteenth of a second."""
    for index, frame in enumerate(indoors.frames):
        assert frame.color.shape == (144, 176, 3)
        assert frame.depth.shape == (144, 176)
        assert frame.timestamp == pytest.approx(index / 15)


def test_the_truth_is_where_depth_is(indoors):
    """In the middle of the visible body the depth is about that of the position, in walking distance; the
    visible box is in the whole one, and nothing hides the person.
    """
    for frame, box, seen, position in zip(
        indoors.frames, indoors.boxes, indoors.visible_boxes, indoors.positions, strict=True
    ):
        x, y = box.center
        depth = frame.depth[int(y) - 12 : int(y) - 2, int(x) - 1 : int(x) + 2]
        assert np.nanmedian(depth) == pytest.approx(position[2], abs=0.25)
        assert NEAREST - 0.6 < np.hypot(*position[[0, 2]]) < FARTHEST + 1.0
        assert seen.iou(box.clip(176, 144)) > 0.8
    np.testing.assert_allclose(indoors.visible, 1.0)


def test_heads_are_on_bodies(indoors):
    """A head is at the upper end of its body, and a sixth to a tenth as high."""
    for head, body in zip(indoors.heads, indoors.boxes, strict=True):
        assert head.y == pytest.approx(body.y, abs=0.5)
        assert 6 < body.height / head.height < 10
        assert body.x - 0.5 < head.x < head.x + head.width < body.x + body.width + 0.5


def test_light_changes_what_is_seen_and_not_where(indoors):
    """Dusk darkens color and leaves the truth, and leaves depth as good as it was."""
    dusk = lit_walker(2, FRAMES, light="dusk")
    assert dusk.boxes == indoors.boxes
    np.testing.assert_array_equal(dusk.positions, indoors.positions)
    assert dusk.frames[-1].color.mean() < 5 < indoors.frames[-1].color.mean()
    assert np.isfinite(dusk.frames[-1].depth).mean() > 0.95


@pytest.mark.parametrize("course", LIGHT_COURSES)
def test_light_is_monotonous(course):
    """Each course begins indoors, and ends there, in darkness, or in the sun."""
    levels = light_levels(course, 90)
    assert levels[0] == 1
    assert levels[-1] == {"indoors": 1, "dusk": 0, "sunrise": BRIGHTEST}[course]
    steps = np.diff(levels)
    assert (steps <= 0).all() or (steps >= 0).all()


def test_the_wall_wraps_beyond_the_range():
    """In a deep hall a range of 15 m shows the wall, one of 7.5 m shows it near, and with the amplitude
    checked it is missing.
    """
    top = slice(0, 30)
    far, near, checked = (
        lit_walker(2, 1, wall=10.5, unambiguous_range=meters, min_reflectance=least).frames[0].depth[top]
        for meters, least in ((15.0, 0.0), (7.5, 0.0), (7.5, 0.15))
    )
    wall = far > 9
    assert wall.mean() > 0.3
    assert np.nanmedian(near[wall]) == pytest.approx(np.nanmedian(far[wall]) - 7.5, abs=0.5)
    assert np.isnan(checked[wall]).mean() > 0.9


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ({"frames": 0}, "frames"),
        ({"light": "noon"}, "light"),
        ({"wall": 3.0}, "wall"),
        ({"unambiguous_range": 0.0}, "unambiguous_range"),
        ({"min_reflectance": 2.0}, "min_reflectance"),
    ],
)
def test_wrong_arguments_are_named(arguments, name):
    """ValueError that begins with the argument's name."""
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        lit_walker(0, **arguments)


def test_the_least_wall_is_said_as_it_is_checked():
    """A wall at 5.5 m is refused, because it has to be farther away."""
    with pytest.raises(ValueError, match=r"wall: expected more than 5\.5 m, got 5\.5"):
        lit_walker(0, 1, wall=5.5)
