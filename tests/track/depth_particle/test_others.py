# SPDX-License-Identifier: MIT
"""What is left out of the search for the target: what wasn't it, and has the depth it had."""

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, DepthParticleTracker, Frame, Intrinsics, _core
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.objects import NOTHING_KNOWN, SAME_DEPTH, SAME_DEPTH_SLOPE
from tricue.track.depth_objects.projection import back_project_box
from tricue.track.depth_particle.others import region_in, remember_others

CAMERA = Intrinsics.from_fov(176, 144, 47.5, 39.5)
NUMBERS = CAMERA.vector
REACH = 0.5
TARGET, Z = Box(60, 40, 30, 80), 3.0
STATE = back_project_box(TARGET, Z, NUMBERS)


def foreground(depth: NDArray[np.float32]) -> Foreground:
    """The whole image."""
    return Foreground(depth, NUMBERS, 1, (0, 0, 176, 144))


def room(left: int = 60) -> NDArray[np.float32]:
    """A wall at 5 m, a desk of the target's depth that it touches, and the target, 30 px wide."""
    depth = np.full((144, 176), 5.0, np.float32)
    depth[90:120, 80:170] = Z
    depth[40:120, left : left + 30] = Z
    return depth


def test_the_target_itself_is_not_remembered():
    """The pixels at its depth in its rectangle are unknown; all others are known, those behind it, too."""
    others = remember_others(_core, NOTHING_KNOWN, foreground(room()), STATE, REACH)
    assert np.isnan(others[40:120, 60:90]).all()
    assert (others[:, :55] == 5).all()
    assert (others[95:115, 100:170] == Z).all()
    assert (others[:30] == 5).all()


def test_what_is_behind_the_target_is_kept_from_before():
    """Where the target is now, what was there without it is still known."""
    before = np.full((144, 176), 5.0, np.float32)
    others = remember_others(_core, before, foreground(room()), STATE, REACH)
    assert (others[40:120, 60:90] == 5).all()


def changed(depth: NDArray[np.float32], others: NDArray[np.float32]) -> NDArray[np.uint8]:
    """1 where objects are looked for."""
    return _core.changed_depth(depth, others, SAME_DEPTH, SAME_DEPTH_SLOPE)


def test_what_stays_as_it_was_is_left_out():
    """Of a target that steps aside its pixels are searched, and those it no longer covers; the wall and the
    desk aren't, though their depths are noisy, and the desk touches the target.
    """
    others = remember_others(_core, NOTHING_KNOWN, foreground(room()), STATE, REACH)
    noise = np.random.default_rng(0).normal(0, 0.01, (144, 176)).astype(np.float32)
    free = changed(room(left=40) + noise, others)
    assert free.dtype == np.uint8
    assert (free[40:120, 40:57] == 1).all()
    assert (free[100:115, 100:170] == 0).all()
    assert (free[:30, :] == 0).all()


def test_unmeasured_pixels_are_searched():
    """Where nothing was known, or is measured now, nothing is left out; there is no warning."""
    unknown = np.full((144, 176), np.nan, np.float32)
    assert (changed(room(), unknown) == 1).all()
    assert (changed(unknown, room()) == 1).all()


@pytest.mark.parametrize("step", [1, 2])
def test_a_box_is_searched_with_a_margin(step):
    """A tenth more than the box is searched, in pixels of the thinned image."""
    fg = Foreground(room()[::step, ::step], NUMBERS / step, step, (0, 0, 176 // step, 144 // step))
    assert [each * step for each in region_in(Box(60, 40, 40, 80), fg)] == [58, 36, 102, 124]
    with_parts = Foreground(room(), NUMBERS, 1, (0, 0, 176, 144))
    assert region_in(Box(60.5, 40.5, 40, 80), with_parts) == (58, 36, 103, 125)
    assert region_in(Box(150, 100, 40, 80), with_parts) == (148, 96, 176, 144)
    left, top, right, bottom = region_in(Box(-40, -40, 20, 20), fg)
    assert (right - left, bottom - top) == (0, 0)


@pytest.mark.parametrize("leave_out", [True, False])
def test_who_touches_furniture_is_an_object(leave_out):
    """A person who walks up to a desk, as far away, and touches it is an object of the own size; where the
    desk may be a part of the person, there is none of that size.
    """
    best = []
    for seed in range(5):
        tracker = DepthParticleTracker(
            intrinsics=CAMERA, floor=False, gap_passes=0, leave_out_others=leave_out, seed=seed
        )
        tracker.init(Frame(depth=room(left=30)), Box(30, 40, 30, 80))
        for left in range(32, 51, 2):
            tracker.update(Frame(depth=room(left)))
        best.append(max(each.iou(Box(50, 40, 30, 80)) for each in tracker.objects))
    # A tenth of the seeds leave a rectangle too narrow, whose rest is taken for furniture.
    assert sum(each > 0.9 for each in best) >= (4 if leave_out else 0)
    assert leave_out or max(best) < 0.6
