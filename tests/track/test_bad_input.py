# SPDX-License-Identifier: MIT
"""What every tracker makes of bad input alike; each tracker's own test_bad_input.py adds the rest."""

import bad_input_cases as cases
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
