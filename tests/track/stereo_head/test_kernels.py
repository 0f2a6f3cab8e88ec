# SPDX-License-Identifier: MIT
"""That the stereo head tracker is the same on native and on reference kernels."""

import copy

import numpy as np
import pytest
from tricue import Status, StereoHeadTracker, Track
from tricue.scenes import StereoScene

FORMS = {
    "usual": {},
    "by color alone": {"ring_weight": 0, "depth_weight": 0, "learn": "all", "compensate_light": False},
    "printed filter": {
        "motion": "constant",
        "noise_model": "polynomial",
        "disparity_noise": 1,
        "disparity_statistic": "mean",
    },
    "fed back": {"feedback": True},
    "unfused": {"fuse": False},
}
SHORT = {"search": (4, 2), "search_frame_after": 10.0}  # the twin counts every place from scratch
SCORE = 2e-6


def on_reference_kernels(tracker: StereoHeadTracker) -> StereoHeadTracker:
    """A tracker in the same state, which goes on with the reference kernels."""
    twin = StereoHeadTracker(kernels="reference")
    twin.__setstate__({**copy.deepcopy(tracker.__getstate__()), "kernels": "reference"})
    return twin


def assert_alike(ours: Track, theirs: Track, pixels: float, meters: float) -> None:
    """The same status, and boxes, scores, positions and covariances as near as said."""
    assert ours.status is theirs.status
    assert np.abs(np.subtract(ours.box, theirs.box)).max() <= pixels
    assert ours.score == pytest.approx(theirs.score, abs=SCORE)
    assert np.abs(ours.position - theirs.position).max() <= meters
    assert np.abs(ours.covariance - theirs.covariance).max() <= meters


def frames_of(scene: StereoScene) -> slice:
    """Some frames before, in and after the time in which the head is hidden."""
    hidden = np.flatnonzero(scene.visible < 0.05)
    return slice(max(hidden[0] - 8, 0), hidden[-1] + 6)


@pytest.mark.parametrize("form", FORMS)
def test_one_step_agrees(form, covered: StereoScene):
    """From one state, one update gives the same track on both sets of kernels, in frames before, in and after
    an occlusion.

    Bins, counts, coherent pixels and disparities are whole numbers or float32 in a fixed order, and equal.
    The native search alone rounds: n M to 2^-(k + 1) a bin, k 19 or more below 4,096 pixels, so that (1) of
    ellipse and ring are off by 2^-20 at most, and a score by 1 + ring_weight of it: 1.6e-6. It moves the
    ellipse only where two of the places are as near; otherwise place and disparity are equal, and the rest is
    float64: a triangulation and a Kalman step on numbers up to 4 m and 300 levels, each rounded to EPS64 of
    it in some hundred operations: 100 x 2.2e-16 x 300 = 7e-12, and as it is meters that count, 1e-13. In
    pixels, with a focal length of 150 at 0.8 m, two hundred times that.
    """
    chosen = frames_of(covered)
    tracker = StereoHeadTracker(rig=covered.rig, **SHORT, **FORMS[form])
    tracker.init(covered.frames[chosen.start], covered.boxes[chosen.start])
    for frame in covered.frames[chosen.start + 1 : chosen.stop : 3]:
        twin = on_reference_kernels(tracker)
        assert_alike(tracker.update(frame), twin.update(frame), 1e-9, 1e-11)


@pytest.mark.parametrize("form", FORMS)
def test_whole_tracks_agree(form, covered: StereoScene, follow):
    """From init on, tracks agree within 1e-8 px and 1e-10 m over ten frames: what one step rounds is carried
    on by a filter whose gain is below one, and nothing multiplies it.
    """
    chosen = slice(frames_of(covered).start, frames_of(covered).start + 10)
    ours, theirs = (
        follow(
            StereoHeadTracker(rig=covered.rig, kernels=kernels, **SHORT, **FORMS[form]),
            covered.frames[chosen],
            covered.boxes[chosen.start],
        )
        for kernels in ("native", "reference")
    )
    for one, other in zip(ours, theirs, strict=True):
        assert_alike(one, other, 1e-8, 1e-10)


def test_those_frames_have_an_occlusion(covered: StereoScene, follow):
    """The frames compared above show the head TRACKED, and not."""
    chosen = frames_of(covered)
    tracks = follow(
        StereoHeadTracker(rig=covered.rig, **SHORT), covered.frames[chosen], covered.boxes[chosen.start]
    )
    assert {track.status for track in tracks[::3]} > {Status.TRACKED}


def test_the_search_over_the_picture_agrees(covered: StereoScene):
    """A head that was lost is found again at the same place, on both sets of kernels."""
    tracker = StereoHeadTracker(rig=covered.rig, search_frame_after=0.0, search=(4, 2))
    tracker.init(covered.frames[0], covered.boxes[0])
    tracker.update(covered.frames[1])
    mirrored = type(covered.frames[2])(
        np.zeros_like(covered.frames[2].color), right=covered.frames[2].right * 0
    )
    tracker.update(mirrored)
    assert tracker._state.missed_seconds > 0
    for frame in covered.frames[3:5]:
        twin = on_reference_kernels(tracker)
        assert_alike(tracker.update(frame), twin.update(frame), 1e-9, 1e-11)
