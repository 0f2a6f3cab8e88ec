# SPDX-License-Identifier: MIT
"""That frames alone decide the stereo head tracker's track to the last bit, whatever happens round it."""

import copy
import pickle
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from tricue import Frame, Status, StereoHeadTracker, Track
from tricue.scenes import StereoScene

HALF = 12  # the head is still seen,
FORMS = {
    "usual": {},
    "as printed": {"params": StereoHeadTracker.Params.paper()},
    "unfused": {"fuse": False},
}

FRESH = """
import tricue
from tricue.scenes import head
scene = head(1, 45, kind="hidden")
tracker = tricue.StereoHeadTracker(rig=scene.rig)
print([tracker.init(scene.frames[0], scene.boxes[0]), *map(tracker.update, scene.frames[1:])])
"""
RESUMED = """
import pathlib, pickle, sys
from tricue.scenes import head
tracker = pickle.loads(pathlib.Path(sys.argv[1]).read_bytes())
print(list(map(tracker.update, head(1, 45, kind="hidden").frames[12:])))
"""


def elsewhere(code: str, *arguments: str) -> str:
    """What another Python process prints; repr shows floats to the last bit."""
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


def part_way(scene: StereoScene, until: int, **parameters) -> tuple[StereoHeadTracker, list[Track]]:
    """A tracker after the first frames of the scene, and the tracks of the others."""
    tracker = StereoHeadTracker(rig=scene.rig, **parameters)
    tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:until]:
        tracker.update(frame)
    return tracker, list(map(copy.deepcopy(tracker).update, scene.frames[until:]))


def hidden_from(scene: StereoScene) -> int:
    """A frame in the middle of the time in which the head isn't seen."""
    return int(np.median(np.flatnonzero(scene.visible < 0.05)))


@pytest.mark.parametrize("form", FORMS)
def test_same_frames_same_track(form, cover_up):
    """Two fresh trackers give the same tracks bit for bit, in the usual, the printed and the unfused form."""
    assert cover_up(**FORMS[form]) == cover_up(**FORMS[form])


def test_forms_differ(cover_up):
    """The forms that are compared above are not all one."""
    ends = [cover_up(**form)[HALF].position.tolist() for form in FORMS.values()]
    assert len(set(map(tuple, ends))) == len(FORMS)


def test_the_seed_changes_nothing(cover_up):
    """There is no randomness in it: every seed gives one track, bit for bit."""
    assert cover_up(seed=0) == cover_up(seed=1) == cover_up(seed=12345)


def test_init_restarts_wholly(covered: StereoScene, follow, cover_up):
    """A tracker that has followed something else before gives a fresh one's tracks, bit for bit."""
    tracker = StereoHeadTracker(rig=covered.rig)
    follow(tracker, covered.frames[::-1], covered.boxes[-1])
    assert follow(tracker, covered.frames, covered.boxes[0]) == cover_up()


def test_another_process_gives_the_same(cover_up):
    """Another Python process, with other hashes and addresses, gives the same track bit for bit."""
    assert elsewhere(FRESH) == repr(cover_up())


def test_trackers_do_not_meet(covered: StereoScene, cover_up):
    """Trackers that take turns frame by frame, on mirrored pairs too, leave each other's track alone."""
    trackers = [StereoHeadTracker(rig=covered.rig, **form) for form in ({}, FORMS["as printed"], {})]
    tracks = [[tracker.init(covered.frames[0], covered.boxes[0])] for tracker in trackers]
    for frame in covered.frames[1:]:
        np.random.seed(0)  # noqa: NPY002 (it must not matter)
        for each, tracker in zip(tracks, trackers, strict=True):
            each.append(tracker.update(frame))
    assert tracks == [cover_up(), cover_up(**FORMS["as printed"]), cover_up()]


def test_threads_do_not_meet(cover_up):
    """Trackers that run at once in threads, where kernels release the GIL, give the tracks that each gives
    alone, bit for bit.
    """
    forms = 4 * list(FORMS.values())
    alone = [cover_up(**form) for form in FORMS.values()]
    with ThreadPoolExecutor(len(forms)) as pool:
        assert list(pool.map(lambda form: cover_up(**form), forms)) == 4 * alone


def test_frames_are_only_read(covered: StereoScene, follow):
    """Frames are left as they were, also writable ones."""
    frames = [Frame(frame.color.copy(), right=frame.right.copy()) for frame in covered.frames]
    follow(StereoHeadTracker(), frames, covered.boxes[0])
    for ours, theirs in zip(frames, covered.frames, strict=True):
        np.testing.assert_array_equal(ours.color, theirs.color)
        np.testing.assert_array_equal(ours.right, theirs.right)


def test_tracks_are_the_callers(covered: StereoScene, cover_up):
    """What is done to a track's arrays doesn't reach the tracker, and later tracks not earlier ones."""
    tracker = StereoHeadTracker(rig=covered.rig)
    kept, spoilt = [], [tracker.init(covered.frames[0], covered.boxes[0])]
    for frame in covered.frames[1:]:
        kept.append(copy.deepcopy(spoilt[-1]))
        spoilt[-1].position[:] = np.nan
        spoilt[-1].covariance[:] = np.nan
        spoilt.append(tracker.update(frame))
    assert [*kept, spoilt[-1]] == cover_up()


def test_frames_may_be_reused(covered: StereoScene, cover_up):
    """A caller may write every frame into one buffer, as cameras do: the tracker keeps none of it."""
    left, right = (np.empty_like(covered.frames[0].color) for _ in range(2))
    tracker, tracks = StereoHeadTracker(rig=covered.rig), []
    for frame in covered.frames:
        left[:], right[:] = frame.color, frame.right
        same = Frame(left, right=right, timestamp=frame.timestamp)
        tracks.append(tracker.update(same) if tracks else tracker.init(same, covered.boxes[0]))
    assert tracks == cover_up()


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("when", ["after init", "seen", "hidden"])
@pytest.mark.parametrize("protocol", [2, pickle.HIGHEST_PROTOCOL])
def test_pickled_in_the_middle(form, when, protocol, covered: StereoScene):
    """A pickled tracker goes on as the original does, bit for bit, while its head is seen and hidden."""
    until = {"after init": 1, "seen": HALF, "hidden": hidden_from(covered)}[when]
    tracker, rest = part_way(covered, until, **FORMS[form])
    restored = pickle.loads(pickle.dumps(tracker, protocol))
    assert list(map(restored.update, covered.frames[until:])) == rest
    assert list(map(tracker.update, covered.frames[until:])) == rest  # nor does pickling change the original


def test_the_hidden_one_is_hidden(covered: StereoScene, cover_up):
    """The pickles above are made of both kinds of state: a head TRACKED, and one that isn't."""
    tracks = cover_up()
    assert tracks[HALF - 1].status is Status.TRACKED
    assert tracks[hidden_from(covered) - 1].status is not Status.TRACKED


def test_pickled_before_init(covered: StereoScene, follow):
    """A tracker can be pickled before its init; rig, seed, parameters and kernels come back."""
    tracker = StereoHeadTracker(seed=7, kernels="reference", search=(2, 1), rig=covered.rig, fuse=False)
    restored = pickle.loads(pickle.dumps(tracker))
    assert (restored.seed, restored.kernels, restored.params) == (7, "reference", tracker.params)
    assert restored.rig == covered.rig
    ours, theirs = (follow(each, covered.frames[:3], covered.boxes[0]) for each in (restored, tracker))
    assert ours == theirs


def test_pickled_while_lost(covered: StereoScene):
    """A tracker pickled in the middle of a search over the picture goes on as the original does."""
    tracker, _ = part_way(covered, HALF, lost_after=0.2)
    black = np.zeros_like(covered.frames[0].color)
    statuses = [tracker.update(Frame(black, right=black)).status for _ in range(9)]
    assert statuses[-1] is Status.LOST
    restored = pickle.loads(pickle.dumps(tracker))
    again = [Frame(frame.color, right=frame.right) for frame in covered.frames[HALF:]]
    assert list(map(restored.update, again)) == list(map(tracker.update, again))


def test_unpickled_in_another_process(covered: StereoScene, tmp_path):
    """A tracker unpickled in another process goes on as the original does, bit for bit."""
    tracker, rest = part_way(covered, HALF)
    path = tmp_path / "tracker.pickle"
    path.write_bytes(pickle.dumps(tracker))
    assert elsewhere(RESUMED, str(path)) == repr(rest)


def test_copies_part(covered: StereoScene):
    """A deep copy and its original share nothing: what one sees doesn't reach the other."""
    tracker, rest = part_way(covered, HALF)
    aside = copy.deepcopy(tracker)
    for frame in covered.frames[:10]:
        aside.update(Frame(frame.color[:, ::-1], right=frame.right[:, ::-1]))
    assert list(map(tracker.update, covered.frames[HALF:])) == rest
