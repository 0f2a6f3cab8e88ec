# SPDX-License-Identifier: MIT
"""That the depth tracker is the same on native and on reference kernels."""

import copy

import numpy as np
import pytest
from tricue import DepthParticleTracker, Frame, Intrinsics, Status, Track
from tricue.scenes import DepthScene

FORMS = {
    "usual": {},
    "absolute": {"histogram": "absolute"},
    "linear": {"likelihood": "linear"},
    "without floor and edges": {"floor": False, "edges": False},
}
MIDDLE = slice(8, 27)  # frames before, in and after the occlusion


def half_size(scene: DepthScene) -> tuple[list[Frame], Intrinsics]:
    """Every other pixel of the frames, 88x72, and the camera that sees them."""
    c = scene.intrinsics
    camera = Intrinsics(c.fx / 2, c.fy / 2, c.cx / 2, c.cy / 2, c.width // 2, c.height // 2)
    return [Frame(depth=f.depth[::2, ::2], timestamp=f.timestamp) for f in scene.frames], camera


def on_reference_kernels(tracker: DepthParticleTracker) -> DepthParticleTracker:
    """A tracker in the same state, which goes on with the reference kernels."""
    twin = DepthParticleTracker(kernels="reference")
    twin.__setstate__({**copy.deepcopy(tracker.__getstate__()), "kernels": "reference"})
    return twin


def assert_alike(ours: Track, theirs: Track, pixels: float, meters: float) -> None:
    """The same status, and boxes, scores, positions and covariances as near as said."""
    assert ours.status is theirs.status
    assert np.abs(np.subtract(ours.box, theirs.box)).max() <= pixels
    assert ours.score == pytest.approx(theirs.score, abs=1e-12)
    assert np.abs(ours.position - theirs.position).max() <= meters
    assert np.abs(ours.covariance - theirs.covariance).max() <= meters


@pytest.mark.parametrize("form", FORMS)
def test_one_step_agrees(form, passing: DepthScene):
    """From one state, one update gives the same track on both sets of kernels, in frames before, in and after
    an occlusion.

    The kernels count pixels and places exactly, on float32 heights and depths in a fixed order; what they
    round otherwise is float64: the mean depth of an object, the plane by least squares, the distance over 64
    levels, weights and their cumulative sums. A mean over a body's 600 pixels at 4 m, summed in another
    order, is off by some sqrt(600) EPS64 4 m = 2e-14 m, more than any other. The object's state goes into the
    log weights with a slope of at most sqrt(2 MAX_OBJECT_COST) / (DEVIATION_FACTOR OBJECT_DEVIATION) = 82 a
    meter in each of five dimensions, so a log weight changes by e = 8e-12, and the weighted mean by 2 e times
    the extent of the particles, 0.2 m: 3e-12 m or 1e-10 px, each with an allowance of some ten. The largest
    seen is 2e-14 px.
    """
    frames, camera = half_size(passing)
    tracker = DepthParticleTracker(seed=1, particles=20, intrinsics=camera, **FORMS[form])
    box = passing.boxes[MIDDLE.start]
    tracker.init(frames[MIDDLE.start], (box.x / 2, box.y / 2, box.width / 2, box.height / 2))
    for frame in frames[MIDDLE.start + 1 : MIDDLE.stop]:
        twin = on_reference_kernels(tracker)
        assert_alike(tracker.update(frame), twin.update(frame), 1e-9, 1e-10)


@pytest.mark.parametrize("form", FORMS)
def test_whole_tracks_agree(form, passing: DepthScene, follow):
    """From init on, over an occlusion, the tracks agree within 1e-8 px and 1e-9 m.

    One step differs by up to 1e-9 px (see above). Later steps carry a difference on, they don't multiply it:
    the same noise, drawn round the same object. Only what crosses a border would: a place of the grid that of
    a pixel, a depth that of a level, a resampled index a tooth. For 19 frames of two sweeps of 20 particles
    with 188 places each, and differences of 1e-13 px, that is a chance of about 1e-8. The largest difference
    seen is 2e-13 px.
    """
    frames, camera = half_size(passing)
    box = passing.boxes[MIDDLE.start]
    half = (box.x / 2, box.y / 2, box.width / 2, box.height / 2)
    ours, theirs = (
        follow(
            DepthParticleTracker(seed=1, particles=20, intrinsics=camera, kernels=kernels, **FORMS[form]),
            frames[MIDDLE],
            half,
        )
        for kernels in ("native", "reference")
    )
    for one, other in zip(ours, theirs, strict=True):
        assert_alike(one, other, 1e-8, 1e-9)


def test_those_frames_have_an_occlusion(passing: DepthScene, follow):
    """The frames compared above show the target TRACKED and OCCLUDED."""
    frames, camera = half_size(passing)
    box = passing.boxes[MIDDLE.start]
    half = (box.x / 2, box.y / 2, box.width / 2, box.height / 2)
    tracks = follow(DepthParticleTracker(seed=1, particles=20, intrinsics=camera), frames[MIDDLE], half)
    assert {track.status for track in tracks} == {Status.TRACKED, Status.OCCLUDED}


def test_the_start_is_alike(walkers):
    """Without a box both start on the same person, at the same place, and divide the frame into the same
    objects.
    """
    scene = walkers[0]
    ours, theirs = (
        DepthParticleTracker(seed=1, particles=20, intrinsics=scene.intrinsics, kernels=kernels)
        for kernels in ("native", "reference")
    )
    assert_alike(ours.init(scene.frames[0]), theirs.init(scene.frames[0]), 1e-9, 1e-9)
    assert len(ours.objects) == len(theirs.objects) > 1
    assert np.abs(np.subtract(ours.objects, theirs.objects)).max() <= 1e-9
