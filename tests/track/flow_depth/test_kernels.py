# SPDX-License-Identifier: MIT
"""That the flow and depth tracker is the same on native and on reference kernels."""

import copy

import numpy as np
import pytest
from tricue import FlowDepthTracker, Status, Track
from tricue.scenes import WalkScene

FORMS = {
    "usual": {},
    "flow": {"cues": ("flow",)},
    "disparity": {"cues": ("disparity",)},
    "one level": {"flow_levels": 1, "disparity_levels": 1},
    "as printed": {"params": FlowDepthTracker.Params.paper()},
}
PIXELS, METERS, PLACES = 1e-4, 1e-5, 3


def on_reference_kernels(tracker: FlowDepthTracker) -> FlowDepthTracker:
    """A tracker in the same state, which goes on with the reference kernels."""
    twin = FlowDepthTracker(kernels="reference")
    twin.__setstate__({**copy.deepcopy(tracker.__getstate__()), "kernels": "reference"})
    return twin


def assert_alike(ours: Track, theirs: Track, steps: int = 1) -> None:
    """The same status, and boxes, scores and positions as near as so many steps leave them."""
    assert ours.status is theirs.status
    assert np.abs(np.subtract(ours.box, theirs.box)).max() <= steps * PIXELS
    assert ours.score == pytest.approx(theirs.score, abs=0.01)
    assert (ours.position is None) == (theirs.position is None)
    if ours.position is not None:
        assert np.abs(ours.position - theirs.position).max() <= steps * METERS
        np.testing.assert_allclose(ours.covariance, theirs.covariance, rtol=1e-4)


@pytest.mark.parametrize("form", FORMS)
def test_one_step_agrees(form, overtaken: WalkScene):
    """From one state, one update gives the same track and mask on both sets of kernels, before and in an
    occlusion.

    Readings and their weights are float32, sums of some hundred products in another order: a weight is off by
    32 EPS32 or 4e-6 of it. The peak is the top of a parabola over smoothed sums of them, which is as wide as
    the smoothing, 1.5 bins of 0.25 places, and so is off by 4e-6 of that, 1.5e-6 places. The target's size is
    a ratio of disparities of 2.7 places or more and moves a corner 40 px from the anchor by 2.2e-5 px, its
    distance of 6.7 m by 4e-6 m. To both an allowance of four, the largest seen is 4e-7 px. A target pixel
    whose reading lies as near to the border of a bin may be one or not: 1,000 have a chance of 1,000 x
    3e-6 / 0.25 each frame that one is, and the scene is always the same; 3 are allowed, none seen.
    """
    tracker = FlowDepthTracker(rig=overtaken.rig, **FORMS[form])
    tracker.init(overtaken.frames[0], overtaken.boxes[0])
    for index, frame in enumerate(overtaken.frames[1:30]):
        if index % 3:
            tracker.update(frame)
            continue
        twin = on_reference_kernels(tracker)
        assert_alike(tracker.update(frame), twin.update(frame))
        assert np.count_nonzero(tracker.mask != twin.mask) <= PLACES
        for ours, theirs in zip(tracker.blocks, twin.blocks, strict=True):
            np.testing.assert_allclose(ours, theirs, rtol=0, atol=PIXELS)


@pytest.mark.parametrize("form", [form for form in FORMS if form != "as printed"])
def test_whole_tracks_agree(form, overtaken: WalkScene, follow):
    """From init on, tracks agree to ten times that over ten frames: steps carry on what the ones before
    rounded, by the velocity that the next one begins with, and add it up. As printed that doesn't hold: one
    pixel more or less moves the box by a whole pixel.
    """
    ours, theirs = (
        follow(
            FlowDepthTracker(rig=overtaken.rig, kernels=kernels, **FORMS[form]),
            overtaken.frames[:11],
            overtaken.boxes[0],
        )
        for kernels in ("native", "reference")
    )
    for one, other in zip(ours, theirs, strict=True):
        assert_alike(one, other, steps=10)


def test_those_frames_have_an_occlusion(overtaken: WalkScene, follow):
    """The frames compared above show the target TRACKED and OCCLUDED."""
    tracks = follow(FlowDepthTracker(rig=overtaken.rig), overtaken.frames[:30], overtaken.boxes[0])
    assert {track.status for track in tracks[1::3]} == {Status.TRACKED, Status.OCCLUDED}
