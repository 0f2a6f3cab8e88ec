# SPDX-License-Identifier: MIT
"""That a seed decides the color particle tracker's track to the last bit, whatever happens round it."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest
from tricue import Box, ColorParticleTracker, Track
from tricue.scenes import Scene

OBSERVATIONS = ("region", "gaussian", "lookup", "histogram", "rank-sections", "rank-spatial")
HALF = 18

FRESH = """
import tricue
from tricue.scenes import face_over_clutter
scene = face_over_clutter(seed=3, frames=36)
tracker = tricue.ColorParticleTracker(seed=7)
print([tracker.init(scene.frames[0], scene.boxes[0]), *map(tracker.update, scene.frames[1:])])
"""
RESUMED = """
import pathlib, pickle, sys
from tricue.scenes import face_over_clutter
tracker = pickle.loads(pathlib.Path(sys.argv[1]).read_bytes())
print(list(map(tracker.update, face_over_clutter(seed=3, frames=36).frames[18:])))
"""


def elsewhere(code: str, *arguments: str) -> str:
    """What another Python process prints; repr shows floats to the last bit."""
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments], capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


def half_way(scene: Scene, **parameters: object) -> tuple[ColorParticleTracker, list[Track]]:
    """A tracker after half of the scene, and the tracks of its other half."""
    tracker = ColorParticleTracker(**parameters)
    tracker.init(scene.frames[0], scene.boxes[0])
    for frame in scene.frames[1:HALF]:
        tracker.update(frame)
    return tracker, list(map(copy.deepcopy(tracker).update, scene.frames[HALF:]))


@pytest.mark.parametrize("observation", OBSERVATIONS)
def test_same_seed_same_track(observation, run):
    """Two fresh trackers with one seed give the same tracks bit for bit, with every observation model."""
    assert run(seed=7, observation=observation) == run(seed=7, observation=observation)


def test_another_seed_another_track(run):
    """Every seed gives a track of its own."""
    ends = {run(seed=seed)[-1].box for seed in range(5)}
    assert len(ends) == 5


def test_init_restarts_wholly(scene: Scene, follow, run):
    """A tracker that has followed something else before gives a fresh one's tracks, bit for bit."""
    tracker = ColorParticleTracker(seed=7)
    follow(tracker, [np.asarray(frame.color)[::2, ::2] for frame in scene.frames], Box(20, 30, 15, 11))
    assert follow(tracker, scene.frames, scene.boxes[0]) == run(seed=7)


def test_another_process_gives_the_same(run):
    """Another Python process, with other hashes and addresses, gives the same track bit for bit."""
    assert elsewhere(FRESH) == repr(run(seed=7))


def test_trackers_do_not_meet(scene: Scene, run):
    """Trackers that take turns frame by frame, and NumPy's global random numbers, leave each other's track
    alone.
    """
    trackers = [ColorParticleTracker(seed=seed) for seed in (7, 8, 7)]
    tracks = [[tracker.init(scene.frames[0], scene.boxes[0])] for tracker in trackers]
    for frame in scene.frames[1:]:
        np.random.seed(0)  # noqa: NPY002 (it must not matter)
        for each, tracker in zip(tracks, trackers, strict=True):
            each.append(tracker.update(frame))
    assert tracks == [run(seed=7), run(seed=8), run(seed=7)]


def test_frames_are_only_read(scene: Scene, follow):
    """Frames are left as they were, also writable ones."""
    frames = [np.array(frame.color) for frame in scene.frames]
    follow(ColorParticleTracker(), frames, scene.boxes[0])
    assert all(np.array_equal(a, b.color) for a, b in zip(frames, scene.frames, strict=True))


@pytest.mark.parametrize("observation", OBSERVATIONS)
@pytest.mark.parametrize("protocol", [2, pickle.HIGHEST_PROTOCOL])
def test_pickled_in_the_middle(observation, protocol, scene: Scene):
    """A pickled tracker goes on as the original does, bit for bit, in the oldest and newest protocol."""
    tracker, rest = half_way(scene, seed=7, observation=observation)
    restored = pickle.loads(pickle.dumps(tracker, protocol))
    assert list(map(restored.update, scene.frames[HALF:])) == rest
    assert list(map(tracker.update, scene.frames[HALF:])) == rest  # nor does pickling change the original


def test_pickled_before_init(scene: Scene, follow, run):
    """A tracker can be pickled before its init; seed, parameters and kernels come back."""
    restored = pickle.loads(pickle.dumps(ColorParticleTracker(seed=7, kernels="reference", particles=50)))
    assert (restored.seed, restored.kernels, restored.params.particles) == (7, "reference", 50)
    assert (
        follow(restored, scene.frames[:5], scene.boxes[0])
        == run(seed=7, kernels="reference", particles=50)[:5]
    )


def test_pickled_while_lost(scene: Scene):
    """A tracker pickled in the middle of a search goes on as the original does, bit for bit."""
    tracker, _ = half_way(scene, seed=7)
    for _ in range(9):
        tracker.update(np.zeros((240, 320, 3), np.uint8))
    restored = pickle.loads(pickle.dumps(tracker))
    again = scene.frames[HALF:]
    assert list(map(restored.update, again)) == list(map(tracker.update, again))


def test_unpickled_in_another_process(scene: Scene, tmp_path):
    """A tracker unpickled in another process goes on as the original does, bit for bit."""
    tracker, rest = half_way(scene, seed=7)
    path = tmp_path / "tracker.pickle"
    path.write_bytes(pickle.dumps(tracker))
    assert elsewhere(RESUMED, str(path)) == repr(rest)


def test_copies_part(scene: Scene):
    """A deep copy and its original share nothing: what one sees doesn't reach the other."""
    tracker, rest = half_way(scene, seed=7)
    aside = copy.deepcopy(tracker)
    for _ in range(10):
        aside.update(np.full((240, 320, 3), 255, np.uint8))
    assert list(map(tracker.update, scene.frames[HALF:])) == rest
