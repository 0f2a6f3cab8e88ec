# SPDX-License-Identifier: MIT
"""A target that is away for seconds is taken up when it is back, and nothing else is meanwhile."""

import numpy as np
import pytest
from tricue import Box, Frame, FusedTracker, Status
from tricue.evaluation import metrics

AWAY_FRAMES = 90  # three seconds
MAX_RECOVERY_FRAMES = 10  # with the whole target
MAX_WRONG_FRAMES = 5  # TRACKED while it is away


@pytest.mark.parametrize("kind", ["leaving", "hidden"])
@pytest.mark.parametrize("seed", range(20, 23))  # docs/fused-figures.md has others
def test_taken_up_after_three_seconds_away(kind, seed):
    """By color alone, in another place."""
    pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")
    from tricue.scenes.stress.scene import stress_scene

    scene = stress_scene(kind, seed, away=AWAY_FRAMES)
    tracker = FusedTracker()
    tracker.init(scene.frames[0], Box(*scene.boxes[0].tolist()))
    tracks = [tracker.update(Frame(each.color, timestamp=each.timestamp)) for each in scene.frames[1:]]
    tracked = np.array([each.status is Status.TRACKED for each in tracks])
    gone = scene.visible[1:] <= 0
    assert (tracked & gone).sum() <= MAX_WRONG_FRAMES
    back = int(np.flatnonzero(gone)[-1]) + 1
    whole = back + int(np.flatnonzero(scene.visible[1 + back :] >= 0.95)[0])
    overlaps = metrics.overlaps(np.array([each.box for each in tracks]), scene.boxes[1:])
    found = tracked & (overlaps > 0.5)
    assert found[whole : whole + MAX_RECOVERY_FRAMES].any()
    assert found[whole + MAX_RECOVERY_FRAMES :].mean() > 0.9
