# SPDX-License-Identifier: MIT
"""That the depth tracker is the same on native and on reference kernels."""

import copy

import numpy as np
import pytest
from tricue import DepthParticleTracker, Frame, Intrinsics, Status, Track
from tricue.scenes import DepthScene

EPS64 = float(np.finfo(np.float64).eps)
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


def assert_alike(ours: Track, theirs: Track, pixels: float, metres: float) -> None:
    """The same status, and boxes, scores, positions and covariances as near as said."""
    assert ours.status is theirs.status
    assert np.abs(np.subtract(ours.box, theirs.box)).max() <= pixels
    assert ours.score == pytest.approx(theirs.score, abs=1e-12)
    assert np.abs(ours.position - theirs.position).max() <= metres
    assert np.abs(ours.covariance - theirs.covariance).max() <= metres


@pytest.mark.parametrize("form", FORMS)
def test_one_step_agrees(form, passing: DepthScene):
    """From one state, one update gives the same track on both sets of kernels, in frames before, in and after
    an occlusion.

    The kernels count pixels and places exactly, on float32 heights and depths in a fixed order; what they
    round otherwise is float64: means of up to 6336 depths, the plane by least squares, the distance over 64
    levels, weights and their cumulative sums. Each is off by a few roundings, a mean by less than its count
    times EPS64 when it is summed in another order. The object's state goes into the log weights with a slope
    of at most 2 sqrt(FAR_OFF / 2) / 0.06 = 82 a metre and dimension, so e, the change of a log weight, is
    below 5 x 82 x 6336 x 8 m x EPS64 = 5e-9 at worst; it changes the weighted mean by 2 e times the extent
    of the particles, as in test_color_kernels.py, and the particles drawn at the object by the same 1e-11 m.
    Two sweeps follow each other. In pixels that is times f / z, and the extent is at most 2 m: 1e-7 px and
    1e-8 m are the bound; what is seen is 1e-11.
    """
    frames, camera = half_size(passing)
    tracker = DepthParticleTracker(seed=1, particles=20, intrinsics=camera, **FORMS[form])
    box = passing.boxes[MIDDLE.start]
    tracker.init(frames[MIDDLE.start], (box.x / 2, box.y / 2, box.width / 2, box.height / 2))
    for frame in frames[MIDDLE.start + 1 : MIDDLE.stop]:
        twin = on_reference_kernels(tracker)
        assert_alike(tracker.update(frame), twin.update(frame), 1e-7, 1e-8)


@pytest.mark.parametrize("form", FORMS)
def test_whole_tracks_agree(form, passing: DepthScene, follow):
    """From init on, over an occlusion, the tracks agree within 1e-6 px and 1e-7 m.

    One step differs by up to 1e-7 px (see above) at the very worst. Later steps carry a difference on, they
    don't multiply it: the same noise, drawn round the same object. Only what crosses a border would, a place
    of the grid that of a pixel, a depth that of a level, a resampled index a tooth, an object the threshold
    of a match; for 19 frames of 40 particles with 140 places and differences of 1e-11 px that is a chance
    of about 1e-6.
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
        assert_alike(one, other, 1e-6, 1e-7)


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


def test_rounding_is_small(passing: DepthScene):
    """One step of a target in sight differs by some roundings only, far under the bounds above."""
    frames, camera = half_size(passing)
    ours, theirs = (
        DepthParticleTracker(seed=1, particles=20, intrinsics=camera, kernels=kernels)
        for kernels in ("native", "reference")
    )
    box = passing.boxes[0]
    for tracker in (ours, theirs):
        tracker.init(frames[0], (box.x / 2, box.y / 2, box.width / 2, box.height / 2))
    assert_alike(ours.update(frames[1]), theirs.update(frames[1]), 1e5 * EPS64, 1e5 * EPS64)
