# SPDX-License-Identifier: MIT
"""That a seed decides the depth particle tracker's track to the last bit, whatever happens round it."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest
from tricue import DepthParticleTracker, Frame, Status, Track
from tricue.scenes import DepthScene

HALF = 12  # the target is still seen,
HIDDEN = 19  # and here it is hidden
FORMS = {"usual": {}, "as printed": {"params": DepthParticleTracker.Params.paper()}}

FRESH = """
import tricue
from tricue.scenes import crossing
scene = crossing(seed=2, frames=36)
tracker = tricue.DepthParticleTracker(seed=7, intrinsics=scene.intrinsics)
print([tracker.init(scene.frames[0], scene.boxes[0]), *map(tracker.update, scene.frames[1:])])
"""
RESUMED = """
import pathlib, pickle, sys
from tricue.scenes import crossing
tracker = pickle.loads(pathlib.Path(sys.argv[1]).read_bytes())
print(list(map(tracker.update, crossing(seed=2, frames=36).frames[12:])))
"""


def elsewhere(code: str, *arguments: str) -> str:
    """What another Python process prints; repr shows floats to the last bit."""
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


def part_way(scene: DepthScene, until: int, **parameters) -> tuple[DepthParticleTracker, list[Track]]:
    """A tracker after the first frames of the scene, and the tracks of the others."""
    tracker = DepthParticleTracker(intrinsics=scene.intrinsics, **parameters)
    tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:until]:
        tracker.update(frame)
    return tracker, list(map(copy.deepcopy(tracker).update, scene.frames[until:]))


@pytest.mark.parametrize("form", FORMS)
def test_same_seed_same_track(form, pass_by):
    """Two fresh trackers with one seed give the same tracks bit for bit, usual and printed form."""
    assert pass_by(seed=7, **FORMS[form]) == pass_by(seed=7, **FORMS[form])


def test_another_seed_another_track(pass_by):
    """Every seed gives a track of its own."""
    assert len({pass_by(seed=seed)[-1].box for seed in range(5)}) == 5


def test_init_restarts_wholly(passing: DepthScene, follow, pass_by):
    """A tracker that has followed somebody else before gives a fresh one's tracks, bit for bit."""
    tracker = DepthParticleTracker(seed=7, intrinsics=passing.intrinsics)
    follow(tracker, passing.frames[::-1], passing.others[-1][0].box)
    assert follow(tracker, passing.frames, passing.boxes[0]) == pass_by(seed=7)


def test_another_process_gives_the_same(pass_by):
    """Another Python process, with other hashes and addresses, gives the same track bit for bit."""
    assert elsewhere(FRESH) == repr(pass_by(seed=7))


def test_trackers_do_not_meet(passing: DepthScene, pass_by):
    """Trackers that take turns frame by frame, and NumPy's global random numbers, leave each other's track
    alone.
    """
    trackers = [DepthParticleTracker(seed=seed, intrinsics=passing.intrinsics) for seed in (7, 8, 7)]
    tracks = [[tracker.init(passing.frames[0], passing.boxes[0])] for tracker in trackers]
    for frame in passing.frames[1:]:
        np.random.seed(0)  # noqa: NPY002 (it must not matter)
        for each, tracker in zip(tracks, trackers, strict=True):
            each.append(tracker.update(frame))
    assert tracks == [pass_by(seed=7), pass_by(seed=8), pass_by(seed=7)]


def test_frames_are_only_read(passing: DepthScene, follow):
    """Frames are left as they were, also writable ones."""
    frames = [Frame(depth=np.array(frame.depth)) for frame in passing.frames]
    follow(DepthParticleTracker(), frames, passing.boxes[0])
    for ours, theirs in zip(frames, passing.frames, strict=True):
        np.testing.assert_array_equal(ours.depth, theirs.depth)


def test_tracks_are_the_callers(passing: DepthScene, follow, pass_by):
    """What is done to a track's arrays doesn't reach the tracker, and later tracks not earlier ones."""
    tracker = DepthParticleTracker(seed=7, intrinsics=passing.intrinsics)
    kept, spoilt = [], [tracker.init(passing.frames[0], passing.boxes[0])]
    for frame in passing.frames[1:]:
        kept.append(copy.deepcopy(spoilt[-1]))
        spoilt[-1].position[:] = np.nan
        spoilt[-1].covariance[:] = np.nan
        tracker.particles[:] = np.nan
        tracker.objects.clear()
        spoilt.append(tracker.update(frame))
    assert [*kept, spoilt[-1]] == pass_by(seed=7)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("until", [1, HALF, HIDDEN], ids=["after init", "seen", "hidden"])
@pytest.mark.parametrize("protocol", [2, pickle.HIGHEST_PROTOCOL])
def test_pickled_in_the_middle(form, until, protocol, passing: DepthScene):
    """A pickled tracker goes on as the original does, bit for bit, while its target is seen and hidden."""
    tracker, rest = part_way(passing, until, seed=7, **FORMS[form])
    restored = pickle.loads(pickle.dumps(tracker, protocol))
    assert list(map(restored.update, passing.frames[until:])) == rest
    assert list(map(tracker.update, passing.frames[until:])) == rest  # nor does pickling change the original


def test_the_hidden_one_is_hidden(pass_by):
    """The pickles above are made of both kinds of state: a target TRACKED, and one OCCLUDED."""
    tracks = pass_by(seed=7)
    assert tracks[HALF - 1].status is Status.TRACKED
    assert tracks[HIDDEN - 1].status is Status.OCCLUDED


def test_pickled_before_init(passing: DepthScene, follow, pass_by):
    """A tracker can be pickled before its init; camera, seed, parameters and kernels come back."""
    tracker = DepthParticleTracker(
        seed=7, kernels="reference", particles=20, intrinsics=passing.intrinsics, aspect=(1, 4)
    )
    restored = pickle.loads(pickle.dumps(tracker))
    assert (restored.seed, restored.kernels, restored.params) == (7, "reference", tracker.params)
    assert restored.intrinsics == passing.intrinsics
    ours, theirs = (follow(each, passing.frames[:3], passing.boxes[0]) for each in (restored, tracker))
    assert ours == theirs


def test_pickled_while_lost(passing: DepthScene):
    """A tracker pickled in the middle of a search goes on as the original does, bit for bit."""
    tracker, _ = part_way(passing, HALF, seed=7, lost_after=0.3)
    empty = Frame(depth=np.full_like(passing.frames[0].depth, np.nan))
    statuses = [tracker.update(empty).status for _ in range(9)]
    assert statuses[-1] is Status.LOST
    restored = pickle.loads(pickle.dumps(tracker))
    again = [Frame(depth=frame.depth) for frame in passing.frames[HALF:]]
    assert list(map(restored.update, again)) == list(map(tracker.update, again))


def test_unpickled_in_another_process(passing: DepthScene, tmp_path):
    """A tracker unpickled in another process goes on as the original does, bit for bit."""
    tracker, rest = part_way(passing, HALF, seed=7)
    path = tmp_path / "tracker.pickle"
    path.write_bytes(pickle.dumps(tracker))
    assert elsewhere(RESUMED, str(path)) == repr(rest)


def test_copies_part(passing: DepthScene):
    """A deep copy and its original share nothing: what one sees doesn't reach the other."""
    tracker, rest = part_way(passing, HALF, seed=7)
    aside = copy.deepcopy(tracker)
    for frame in passing.frames[:10]:
        aside.update(Frame(depth=frame.depth[:, ::-1]))
    assert list(map(tracker.update, passing.frames[HALF:])) == rest
