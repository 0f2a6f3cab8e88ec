# SPDX-License-Identifier: MIT
"""What every tracker makes of bad input alike; each tracker's own test_bad_input.py adds the rest."""

import bad_input_cases as cases
import cv2
import numpy as np
import pytest
from tricue import (
    ColorParticleTracker,
    DepthParticleTracker,
    FlowDepthTracker,
    Frame,
    FusedTracker,
    StereoHeadTracker,
)

PAIR = Frame(cases.LEFT, right=cases.RIGHT)
FRAMES = {
    ColorParticleTracker: cases.LEFT,
    DepthParticleTracker: Frame(depth=cases.METERS),
    StereoHeadTracker: PAIR,
    FlowDepthTracker: PAIR,
    FusedTracker: cases.LEFT,
}


@pytest.mark.parametrize("tracker", FRAMES)
def test_update_before_init_is_named(tracker):
    """Update before init, and after an init that failed, is a RuntimeError that says what to do."""
    cases.assert_init_comes_first(tracker(), FRAMES[tracker])


SMOOTH = cv2.GaussianBlur(cases.LEFT, (0, 0), 1.5)
MATCHING = Frame(SMOOTH, right=np.roll(SMOOTH, -6, axis=1))
DEPTH = Frame(depth=np.where(np.arange(cases.WIDTH) < 90, cases.METERS, 4))
SIZED = {
    DepthParticleTracker: (DEPTH, {"intrinsics": cases.CAMERA}),
    StereoHeadTracker: (MATCHING, {"rig": cases.RIG}),
    FlowDepthTracker: (MATCHING, {"rig": cases.RIG}),
    FusedTracker: (MATCHING, {"rig": cases.RIG}),
}


@pytest.mark.parametrize("tracker", SIZED)
def test_another_size_says_what_to_do(tracker):
    """The error says whether init would start again on another size: with a camera it wouldn't."""
    frame, camera = SIZED[tracker]
    small = Frame(**{name: getattr(frame, name)[:90, :120] for name in frame.channels})
    for made, hint in (tracker(), "init starts again"), (tracker(**camera), "another size needs another"):
        made.init(frame, (40, 20, 40, 50))
        with pytest.raises(ValueError, match=f"expected the first frame's .*; .*{hint}"):
            made.update(small)
        if made.rig or made.intrinsics:
            with pytest.raises(ValueError, match="size, 128x96, got 120x90"):
                made.init(small, (40, 20, 40, 50))
        else:
            made.init(small, (40, 20, 40, 50))
