# SPDX-License-Identifier: MIT
"""That frames alone decide the flow and depth tracker's track to the last bit, whatever happens round it."""

import copy
import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from tricue import FlowDepthTracker, Frame, Status, Track
from tricue.scenes import WalkScene

SEEN, HIDDEN = 12, 32  # frames in which the target is seen, and isn't
FORMS = {
    "usual": {},
    "flow": {"cues": ("flow",)},
    "disparity": {"cues": ("disparity",)},
    "one level": {"flow_levels": 1, "disparity_levels": 1},
}
CUT = 16  # frames that another process makes again

FRESH = f"""
import tricue
from tricue.scenes import overtaking
scene = overtaking(0, {CUT})
tracker = tricue.FlowDepthTracker(rig=scene.rig)
print([tracker.init(scene.frames[0], scene.boxes[0]), *map(tracker.update, scene.frames[1:])])
"""


def part_way(scene: WalkScene, until: int, **parameters) -> tuple[FlowDepthTracker, list[Track]]:
    """A tracker after the first frames of the scene, and the tracks of the others."""
    tracker = FlowDepthTracker(rig=scene.rig, **parameters)
    tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:until]:
        tracker.update(frame)
    return tracker, list(map(copy.deepcopy(tracker).update, scene.frames[until:]))


@pytest.mark.parametrize("form", FORMS)
def test_same_frames_same_track(form, walk_on):
    """Two fresh trackers give the same tracks bit for bit, with both cues, with each, and on one level."""
    assert walk_on(**FORMS[form]) == walk_on(**FORMS[form])


def test_forms_differ(walk_on):
    """The forms that are compared above are not all one."""
    assert len({walk_on(**form)[SEEN].box for form in FORMS.values()}) == len(FORMS)


def test_the_seed_changes_nothing(walk_on):
    """There is no randomness in it: every seed gives one track, bit for bit."""
    assert walk_on(seed=0) == walk_on(seed=1) == walk_on(seed=12345)


def test_masks_and_blocks_are_the_same(overtaken: WalkScene):
    """Masks and blocks are the same too, bit for bit, and those of a frame stay so however often they are
    asked for.
    """
    trackers = [FlowDepthTracker(rig=overtaken.rig) for _ in range(2)]
    for tracker in trackers:
        tracker.init(overtaken.frames[0], overtaken.boxes[0])
    for frame in overtaken.frames[1:30]:
        for tracker in trackers:
            tracker.update(frame)
        ours, theirs = trackers
        np.testing.assert_array_equal(ours.mask, theirs.mask)
        np.testing.assert_array_equal(ours.mask, ours.mask)
        assert ours.blocks == theirs.blocks == ours.blocks


def test_init_restarts_wholly(overtaken: WalkScene, follow, walk_on):
    """A tracker that has followed something else before, in pictures of another size too, gives a fresh one's
    tracks, bit for bit.
    """
    tracker = FlowDepthTracker(rig=overtaken.rig)
    follow(tracker, overtaken.frames[:20][::-1], overtaken.boxes[19])
    assert follow(tracker, overtaken.frames, overtaken.boxes[0]) == walk_on()
    anywhere = FlowDepthTracker()
    half = [Frame(frame.color[::2, ::2], right=frame.right[::2, ::2]) for frame in overtaken.frames[:4]]
    follow(anywhere, half, tuple(side / 2 for side in overtaken.boxes[0]))
    fresh = follow(FlowDepthTracker(), overtaken.frames[:9], overtaken.boxes[0])
    assert follow(anywhere, overtaken.frames[:9], overtaken.boxes[0]) == fresh


def test_another_process_gives_the_same(overtakings, follow):
    """Another Python process, with other hashes and addresses, gives the same track bit for bit."""
    scene = overtakings(0, CUT)
    ours = follow(FlowDepthTracker(rig=scene.rig), scene.frames, scene.boxes[0])
    done = subprocess.run([sys.executable, "-c", FRESH], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == repr(ours)


def test_trackers_do_not_meet(overtaken: WalkScene, walk_on):
    """Trackers that take turns frame by frame leave each other's track alone."""
    trackers = [FlowDepthTracker(rig=overtaken.rig, **form) for form in FORMS.values()]
    tracks = [[tracker.init(overtaken.frames[0], overtaken.boxes[0])] for tracker in trackers]
    for frame in overtaken.frames[1:]:
        np.random.seed(0)  # noqa: NPY002 (it must not matter)
        for each, tracker in zip(tracks, trackers, strict=True):
            each.append(tracker.update(frame))
    assert tracks == [walk_on(**form) for form in FORMS.values()]


def test_threads_do_not_meet(walk_on):
    """Trackers that run at once in threads, where kernels release the GIL, give the tracks that each gives
    alone, bit for bit.
    """
    forms = 2 * list(FORMS.values())
    alone = [walk_on(**form) for form in FORMS.values()]
    with ThreadPoolExecutor(len(forms)) as pool:
        assert list(pool.map(lambda form: walk_on(**form), forms)) == 2 * alone


def test_frames_are_only_read(overtaken: WalkScene, follow):
    """Frames are left as they were, also writable ones."""
    frames = [Frame(frame.color.copy(), right=frame.right.copy()) for frame in overtaken.frames[:20]]
    follow(FlowDepthTracker(), frames, overtaken.boxes[0])
    for ours, theirs in zip(frames, overtaken.frames, strict=False):
        np.testing.assert_array_equal(ours.color, theirs.color)
        np.testing.assert_array_equal(ours.right, theirs.right)


def test_what_is_given_out_is_the_callers(overtaken: WalkScene, walk_on):
    """What is done to a track's arrays and to a mask doesn't reach the tracker, and later tracks not earlier
    ones.
    """
    tracker = FlowDepthTracker(rig=overtaken.rig)
    kept, spoilt = [], [tracker.init(overtaken.frames[0], overtaken.boxes[0])]
    for frame in overtaken.frames[1:]:
        kept.append(copy.deepcopy(spoilt[-1]))
        spoilt[-1].position[:] = np.nan
        spoilt[-1].covariance[:] = np.nan
        tracker.mask[:] = 255
        spoilt.append(tracker.update(frame))
    assert [*kept, spoilt[-1]] == walk_on()


@pytest.mark.parametrize("gray", [False, True])
def test_frames_may_be_reused(gray, overtaken: WalkScene, follow):
    """A caller may write every frame into one buffer, as cameras do, in color and in gray: the tracker keeps
    none of it.
    """
    frames = [
        Frame(frame.color[..., 1].copy(), right=frame.right[..., 1].copy()) if gray else frame
        for frame in overtaken.frames[:20]
    ]
    left, right = (np.empty_like(frames[0].color) for _ in range(2))
    tracker, tracks = FlowDepthTracker(), []
    for frame in frames:
        left[:], right[:] = frame.color, frame.right
        same = Frame(left, right=right, timestamp=frame.timestamp)
        tracks.append(tracker.update(same) if tracks else tracker.init(same, overtaken.boxes[0]))
    assert tracks == follow(FlowDepthTracker(), frames, overtaken.boxes[0])


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("until", [1, SEEN, HIDDEN])
@pytest.mark.parametrize("protocol", [2, pickle.HIGHEST_PROTOCOL])
def test_pickled_in_the_middle(form, until, protocol, overtaken: WalkScene):
    """A pickled tracker goes on as the original does, bit for bit, from its start, while its target is seen
    and while it is hidden; its mask comes with it.
    """
    tracker, rest = part_way(overtaken, until, **FORMS[form])
    restored = pickle.loads(pickle.dumps(tracker, protocol))
    np.testing.assert_array_equal(restored.mask, tracker.mask)
    assert list(map(restored.update, overtaken.frames[until:])) == rest
    assert (
        list(map(tracker.update, overtaken.frames[until:])) == rest
    )  # nor does pickling change the original


def test_the_hidden_one_is_hidden(walk_on):
    """The pickles above are made of both kinds of state: a target TRACKED, and one OCCLUDED."""
    tracks = walk_on()
    assert tracks[SEEN - 1].status is Status.TRACKED
    assert tracks[HIDDEN - 1].status is Status.OCCLUDED


def test_pickled_before_init(overtaken: WalkScene, follow):
    """A tracker can be pickled before its init; rig, seed, parameters and kernels come back."""
    tracker = FlowDepthTracker(seed=7, kernels="reference", bins=32, rig=overtaken.rig)
    restored = pickle.loads(pickle.dumps(tracker))
    assert (restored.seed, restored.kernels, restored.params) == (7, "reference", tracker.params)
    assert restored.rig == overtaken.rig
    ours, theirs = (follow(each, overtaken.frames[:3], overtaken.boxes[0]) for each in (restored, tracker))
    assert ours == theirs


def test_copies_part(overtaken: WalkScene):
    """A deep copy and its original share nothing: what one sees doesn't reach the other."""
    tracker, rest = part_way(overtaken, SEEN)
    aside = copy.deepcopy(tracker)
    for frame in overtaken.frames[:10]:
        aside.update(Frame(frame.color[:, ::-1], right=frame.right[:, ::-1]))
    assert list(map(tracker.update, overtaken.frames[SEEN:])) == rest
