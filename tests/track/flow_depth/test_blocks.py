# SPDX-License-Identifier: MIT
"""That blocks change their states as in figure 7, move and grow with the target, and make its window."""

import math

import numpy as np
import pytest
from tricue import FlowDepthTracker
from tricue.kernels import load
from tricue.track.flow_depth.blocks import (
    NOT_TARGET_BLOCK,
    OCCLUDED_BLOCK,
    TARGET_BLOCK,
    TRUSTED_FRAMES,
    BlockObservation,
    Blocks,
    DisparityLimits,
)

P = FlowDepthTracker.Params()
K = load("native")
OURS, NEAREST, OCCLUDER, WALL = 12.0, 14.0, 20.0, 4.0  # disparities, cells
LIMITS = DisparityLimits(target=OURS, tolerance=0.75, occluder=NEAREST)
FULL = 40  # cells of a block


def seen(
    targets: int = 0, mean: float = OURS, measured: int = FULL, same_depth: int = 0, cells: int = FULL
) -> BlockObservation:
    """What a frame measures in one block."""
    counts = (np.array([number], np.int64) for number in (cells, targets, measured, same_depth))
    here, mine, read, near = counts
    return BlockObservation(here, mine, read, np.array([mean]), near)


GOOD = seen(targets=FULL)
BEHIND = seen(mean=OCCLUDER)
AWAY = seen(mean=WALL)
BLANK = seen(measured=0, mean=math.nan)
OUTSIDE = seen(cells=0, measured=0, mean=math.nan)


def block(state: int, core: bool = True) -> Blocks:
    """One block of 8x5 cells at (0, 0), of that state, without votes."""
    none = np.zeros(1, np.int64)
    return Blocks(
        corners=np.array([[0.0, 0.0, 8.0, 5.0]]),
        anchor=(0.0, 0.0),
        size=1.0,
        states=np.array([state]),
        votes=none,
        votes_against=none,
        core=np.array([core]),
        trusted=np.array([TRUSTED_FRAMES if state == TARGET_BLOCK else 0]),
        frames_without_pixels=np.array([0]),
    )


def states(start: Blocks, *frames: BlockObservation, p=P) -> list[int]:
    """The block's state after each frame."""
    after = []
    for frame in frames:
        start = start.voted(K, frame, LIMITS, p)
        after.append(int(start.states[0]))
    return after


def test_votes_make_a_target():
    """A block that isn't the target's becomes so in the frame of its third vote, not before."""
    assert states(block(NOT_TARGET_BLOCK, core=False), *3 * [GOOD]) == [
        NOT_TARGET_BLOCK,
        NOT_TARGET_BLOCK,
        TARGET_BLOCK,
    ]


@pytest.mark.parametrize("votes", [1, 2, 7])
def test_as_many_votes_as_are_asked_for(votes):
    """The number of votes is the parameter's."""
    after = states(
        block(NOT_TARGET_BLOCK, core=False), *votes * [GOOD], p=FlowDepthTracker.Params(votes_to_add=votes)
    )
    assert after == (votes - 1) * [NOT_TARGET_BLOCK] + [TARGET_BLOCK]


def test_a_frame_without_takes_a_vote_back():
    """Frames without target pixels take votes back, one each, and never below none."""
    start = block(NOT_TARGET_BLOCK, core=False)
    assert states(start, GOOD, GOOD, AWAY, GOOD, GOOD)[-2:] == [NOT_TARGET_BLOCK, TARGET_BLOCK]
    assert states(start, *9 * [AWAY], *3 * [GOOD])[-2:] == [NOT_TARGET_BLOCK, TARGET_BLOCK]


@pytest.mark.parametrize(("targets", "state"), [(9, NOT_TARGET_BLOCK), (10, TARGET_BLOCK)])
def test_enough_target_pixels_are_a_vote(targets, state):
    """A quarter of a block's 40 cells gives a vote, one less doesn't."""
    assert states(block(NOT_TARGET_BLOCK, core=False), *3 * [seen(targets=targets)])[-1] == state


def test_something_nearer_hides_a_target():
    """A target block without target pixels, before which something is nearer, is occluded at once, for as
    long as that is there, and the target's again at its disparity.
    """
    after = states(block(TARGET_BLOCK), GOOD, *9 * [BEHIND], seen(same_depth=FULL))
    assert after == [TARGET_BLOCK, *9 * [OCCLUDED_BLOCK], TARGET_BLOCK]


def test_target_pixels_count_before_disparity():
    """A block with enough target pixels isn't occluded, whatever its mean disparity."""
    assert states(block(TARGET_BLOCK), seen(targets=FULL, mean=OCCLUDER)) == [TARGET_BLOCK]


@pytest.mark.parametrize(
    ("mean", "state"), [(NEAREST, TARGET_BLOCK), (np.nextafter(NEAREST, 99), OCCLUDED_BLOCK)]
)
def test_only_what_is_nearer_hides(mean, state):
    """The mean disparity has to be above the one from which something is nearer."""
    assert states(block(TARGET_BLOCK), seen(mean=mean)) == [state]


@pytest.mark.parametrize(("measured", "state"), [(7, TARGET_BLOCK), (8, OCCLUDED_BLOCK)])
def test_few_disparities_hide_nothing(measured, state):
    """A fifth of a block's cells must have a disparity until it counts as that of something nearer."""
    assert states(block(TARGET_BLOCK), seen(mean=OCCLUDER, measured=measured)) == [state]


def test_votes_against_end_a_target():
    """A target block that shows neither target nor something nearer isn't the target's from the fourth frame
    on.
    """
    assert states(block(TARGET_BLOCK), *5 * [AWAY]) == [
        TARGET_BLOCK,
        TARGET_BLOCK,
        TARGET_BLOCK,
        NOT_TARGET_BLOCK,
        NOT_TARGET_BLOCK,
    ]


def test_a_target_pixel_ends_the_votes_against():
    """One frame with target pixels lets the count against begin again."""
    assert states(block(TARGET_BLOCK), *3 * [AWAY], GOOD, *4 * [AWAY])[-2:] == [
        TARGET_BLOCK,
        NOT_TARGET_BLOCK,
    ]


def test_who_was_voted_out_starts_from_none():
    """A block that was voted out needs all votes again, though it had them."""
    after = states(block(TARGET_BLOCK, core=False), *5 * [GOOD], *4 * [AWAY], *3 * [GOOD])
    assert after[8:] == [NOT_TARGET_BLOCK, NOT_TARGET_BLOCK, NOT_TARGET_BLOCK, TARGET_BLOCK]


@pytest.mark.parametrize(
    "frame", [BLANK, OUTSIDE, seen(mean=WALL, measured=7)], ids=["blank", "outside", "few"]
)
def test_nothing_is_no_vote_against(frame):
    """A block in which hardly anything is read, or that is outside the picture, stays the target's."""
    assert states(block(TARGET_BLOCK), *20 * [frame])[-1] == TARGET_BLOCK


def test_outside_the_picture_votes_stay():
    """Frames in which a block is outside the picture neither give nor take votes."""
    assert states(block(NOT_TARGET_BLOCK, core=False), GOOD, GOOD, *9 * [OUTSIDE], GOOD)[-2:] == [
        NOT_TARGET_BLOCK,
        TARGET_BLOCK,
    ]


@pytest.mark.parametrize("core", [True, False])
def test_depth_alone_holds_the_first_window_only(core):
    """At the target's disparity, without target pixels, a block of the first window is voted in; another
    isn't.
    """
    same_depth = seen(same_depth=FULL)
    assert states(block(NOT_TARGET_BLOCK, core), *9 * [same_depth])[-1] == (
        TARGET_BLOCK if core else NOT_TARGET_BLOCK
    )


def test_an_occluded_block_waits():
    """An occluded block of which nothing is read, or that left the picture, stays occluded."""
    assert states(block(OCCLUDED_BLOCK), *9 * [BLANK], *9 * [OUTSIDE])[-1] == OCCLUDED_BLOCK


@pytest.mark.parametrize("mean", [WALL, OURS - 0.76, OURS + 0.76, NEAREST])
def test_the_background_ends_no_occlusion(mean):
    """An occluded block whose mean disparity isn't similar to the target's stays occluded, though nothing
    nearer hides it: section 4.4 returns it to the target by a similar one alone.
    """
    frames = [seen(mean=mean), seen(mean=mean), BLANK, seen(mean=mean)]
    assert states(block(OCCLUDED_BLOCK), *frames) == 4 * [OCCLUDED_BLOCK]


@pytest.mark.parametrize("mean", [OURS - 0.75, OURS, OURS + 0.75])
def test_a_similar_disparity_ends_an_occlusion(mean):
    """An occluded block whose mean disparity is similar to the target's is the target's at once, with or
    without target pixels; a mean of too few cells doesn't count.
    """
    assert states(block(OCCLUDED_BLOCK), seen(mean=mean, measured=7), seen(mean=mean)) == [
        OCCLUDED_BLOCK,
        TARGET_BLOCK,
    ]


@pytest.mark.parametrize("frames", [2, 8])
def test_the_background_releases_an_occluded_block_late(frames):
    """An occluded block that shows what is behind the target in ``votes_to_release`` frames isn't the
    target's any more; something nearer in between takes no vote back, and a similar disparity all of them.
    """
    p = FlowDepthTracker.Params(votes_to_release=frames)
    shown = [AWAY, BEHIND, *(frames - 1) * [AWAY]]
    assert states(block(OCCLUDED_BLOCK), *shown, p=p) == frames * [OCCLUDED_BLOCK] + [NOT_TARGET_BLOCK]
    back = [*(frames - 1) * [AWAY], seen(same_depth=FULL), BLANK, *3 * [AWAY]]
    assert states(block(OCCLUDED_BLOCK), *back, p=p)[frames - 1 :] == 5 * [TARGET_BLOCK]


def test_no_other_state_is_occluded():
    """Something nearer before a block that isn't the target's doesn't make it occluded."""
    assert states(block(NOT_TARGET_BLOCK), *9 * [BEHIND])[-1] == NOT_TARGET_BLOCK


def test_blocks_stay_trusted_for_a_while():
    """A block's measured count for so many frames after its last target pixels; while it is hidden the time
    stands still.
    """
    start = block(TARGET_BLOCK).voted(K, GOOD, LIMITS, P)
    for expected in (TRUSTED_FRAMES - 1, TRUSTED_FRAMES - 2):
        start = start.voted(K, AWAY, LIMITS, P)
        assert start.trusted[0] == expected
    for frame in (BEHIND, BEHIND):
        start = start.voted(K, frame, LIMITS, P)
        assert start.trusted[0] == TRUSTED_FRAMES - 2
    assert start.voted(K, GOOD, LIMITS, P).trusted[0] == TRUSTED_FRAMES


def test_a_vote_changes_a_copy():
    """Voting leaves the blocks it began with as they were: an update that fails has changed nothing."""
    start = Blocks.of((10.0, 10.0, 30.0, 60.0), P)
    kept = [np.copy(field) for field in start]
    many = BlockObservation(*(np.repeat(field, len(start.states)) for field in BEHIND))
    assert (start.voted(K, many, LIMITS, P).states == OCCLUDED_BLOCK).any()
    for field, before in zip(start, kept, strict=True):
        np.testing.assert_array_equal(field, before)


WINDOWS = {
    "a person": (50.0, 20.0, 80.0, 110.0),
    "fractions": (50.3, 20.7, 61.1, 55.2),
    "2 cells": (7.0, 7.0, 9.0, 9.0),
    "wide": (-100.0, 45.0, 200.0, 47.0),
}


@pytest.mark.parametrize("name", WINDOWS)
def test_the_first_window_is_tiled(name):
    """The core blocks are target blocks, fill the given window without gap or overlap, and are its window; no
    other block is the target's.
    """
    blocks = Blocks.of(WINDOWS[name], P)
    x0, y0, x1, y1 = WINDOWS[name]
    mine = blocks.rectangles[blocks.core]
    areas = (mine[:, 2] - mine[:, 0]) * (mine[:, 3] - mine[:, 1])
    assert areas.min() > 0
    assert areas.sum() == pytest.approx((x1 - x0) * (y1 - y0))
    assert blocks.window == pytest.approx(WINDOWS[name])
    np.testing.assert_array_equal(blocks.states == TARGET_BLOCK, blocks.core)
    assert len(np.unique(np.round(blocks.rectangles, 6), axis=0)) == len(blocks.states)


@pytest.mark.parametrize("name", WINDOWS)
def test_the_grid_is_larger_on_every_side(name):
    """There are blocks beyond each side of the first window, by which arms and legs can be added."""
    x0, y0, x1, y1 = WINDOWS[name]
    grid = Blocks.of(WINDOWS[name], P).rectangles
    assert grid[:, 0].min() < x0 < x1 < grid[:, 2].max()
    assert grid[:, 1].min() < y0 < y1 < grid[:, 3].max()


def test_blocks_have_the_share_that_is_asked_for():
    """Blocks are about ``block_side`` of the window's side long, and never much smaller than 3 cells."""
    for share in (0.1, 0.2, 0.5, 1.0):
        blocks = Blocks.of((0.0, 0.0, 60.0, 60.0), FlowDepthTracker.Params(block_side=share))
        assert blocks.core.sum() == round(1 / share) ** 2
    small = Blocks.of((0.0, 0.0, 9.0, 9.0), FlowDepthTracker.Params(block_side=0.01))
    assert small.core.sum() == 9


@pytest.mark.parametrize(
    ("window", "share"),
    [((0.0, -5e5, 2.0, 5e5), 0.15), ((-5e5, 0.0, 5e5, 2.0), 0.15), ((-5e5, -5e5, 5e5, 5e5), 1e-9)],
    ids=["high", "wide", "fine"],
)
def test_there_are_never_too_many_blocks(window, share):
    """Windows as thin and large as boxes may be, and blocks as small, make some thousand blocks at most: no
    memory is asked for that isn't there.
    """
    blocks = Blocks.of(window, FlowDepthTracker.Params(block_side=share))
    assert blocks.window == pytest.approx(window)
    assert len(blocks.states) <= 15_000


def test_blocks_move_and_grow_round_their_anchor():
    """Moved blocks are where they were, and so far on; larger ones have their corners so many times as far
    from the window's middle.
    """
    blocks = Blocks.of((10.0, 20.0, 40.0, 80.0), P)
    np.testing.assert_allclose(blocks.moved(3.5, -2).rectangles, blocks.rectangles + [3.5, -2, 3.5, -2])
    larger = blocks.resized(1.5)
    np.testing.assert_array_equal(larger.states, blocks.states)
    assert larger.window == pytest.approx((2.5, 5.0, 47.5, 95.0))


def test_without_a_block_there_is_no_window():
    """A target of whose blocks none is left has no window."""
    assert block(NOT_TARGET_BLOCK).window is None


PRINTED = FlowDepthTracker.Params(block_rules="printed", votes_to_add=2, votes_to_remove=3)


def test_as_printed_blocks_divide_the_first_window():
    """By the printed rules there is no block around the first window, and all are Not_Target."""
    blocks = Blocks.of(WINDOWS["a person"], PRINTED)
    assert (blocks.states == NOT_TARGET_BLOCK).all()
    assert blocks.core.all()
    np.testing.assert_allclose(blocks.rectangles[0, :2], WINDOWS["a person"][:2])
    np.testing.assert_allclose(blocks.rectangles[-1, 2:], WINDOWS["a person"][2:])
    assert blocks.window is None


def test_as_printed_votes_add_up():
    """Votes by target pixels add up over all frames, and depth alone gives none."""
    frames = [GOOD, AWAY, seen(same_depth=FULL), GOOD]
    assert states(block(NOT_TARGET_BLOCK), *frames, p=PRINTED) == 3 * [NOT_TARGET_BLOCK] + [TARGET_BLOCK]


@pytest.mark.parametrize("frame", [AWAY, seen(same_depth=FULL), BLANK], ids=["away", "depth", "blank"])
def test_as_printed_negative_votes_add_up(frame):
    """Without target pixels, and without something nearer, a target block gets a vote against it, also at the
    target's depth; target pixels in between take none back. Outside of the image there are none.
    """
    frames = [frame, GOOD, OUTSIDE, frame, GOOD, frame]
    assert states(block(TARGET_BLOCK), *frames, p=PRINTED) == 5 * [TARGET_BLOCK] + [NOT_TARGET_BLOCK]


def test_as_printed_an_occlusion_ends_at_a_similar_disparity():
    """Something nearer hides a target block without target pixels; only a similar disparity brings it back,
    however long something else is seen there.
    """
    frames = [seen(targets=FULL, mean=OCCLUDER), BEHIND, *40 * [AWAY], BLANK, seen()]
    after = states(block(TARGET_BLOCK), *frames, p=PRINTED)
    assert after == [TARGET_BLOCK, *42 * [OCCLUDED_BLOCK], TARGET_BLOCK]


def test_as_printed_a_new_state_has_no_votes():
    """Who was voted out needs all votes again, and who was voted in all votes against."""
    frames = [GOOD, GOOD, *3 * [AWAY], GOOD, GOOD, AWAY]
    after = states(block(NOT_TARGET_BLOCK), *frames, p=PRINTED)
    assert after == [
        *[NOT_TARGET_BLOCK, TARGET_BLOCK, TARGET_BLOCK, TARGET_BLOCK],
        *[NOT_TARGET_BLOCK, NOT_TARGET_BLOCK, TARGET_BLOCK, TARGET_BLOCK],
    ]
