# SPDX-License-Identifier: MIT
from dataclasses import replace

import numpy as np
import pytest
from tricue import FlowDepthTracker, Status, Track
from tricue.papers.experiment import Case
from tricue.papers.okada import following, following_curves, following_figures
from tricue.papers.okada.experiments import EXPERIMENTS
from tricue.papers.okada.following_curves import FollowCurve
from tricue.scenes import HeadLimits, pan_tilt_scene

EXPERIMENT = EXPERIMENTS["okada-follow"]
FRAMES = 45


class Knowing:
    """Finds the target by its looks alone: a tracker that is told the truth through the scene it watches."""

    traits = FlowDepthTracker.traits

    def __init__(self, box=None):
        self._box = box

    def init(self, frame, box):
        self._box = self._box or box
        return self.update(frame)

    def update(self, frame):
        return Track(self._box, 1.0, Status.TRACKED)


@pytest.fixture(scope="module")
def loop():
    """The closed loop with the default tracker."""
    scene = pan_tilt_scene(2, FRAMES)
    return following.measure(Case("m", "s", 0), EXPERIMENT.models["default"], scene)


def test_the_loop_is_closed(loop):
    """The camera turns towards the target, which comes to the middle third and stays there."""
    assert loop.errors[0].max() > 1
    assert loop.in_middle[loop.settled].all()
    assert np.abs(loop.angles[-1] - loop.angles[0]).max() > np.radians(1)
    assert tuple(loop.frames) == following_figures.key_frames(FRAMES)


def test_a_box_off_the_target_turns_the_camera_away():
    """The camera goes where the tracker says, whatever the truth is."""
    scene = pan_tilt_scene(2, FRAMES)
    at = scene.truth(0, *scene.start).seen.target.box
    aside = at._replace(x=at.x + 30)
    curve = following.measure(Case("m", "s", 1), lambda **_: Knowing(aside), scene)
    assert curve.angles[-1, 0] - curve.angles[0, 0] > np.radians(3)
    assert curve.frames == {}


def test_a_head_that_stands_still_stands_still():
    """That scene's head does nothing."""
    scene = pan_tilt_scene(2, 20, limits=following.STANDING_HEAD)
    curve = following.measure(Case("m", "s", 1), lambda **_: Knowing(), scene)
    np.testing.assert_allclose(curve.angles, np.tile(scene.start, (20, 1)), atol=1e-6)
    assert HeadLimits().max_speed > 1


def test_models_are_the_default_and_the_paper():
    """As printed is the paper's parameters and nothing else."""
    default, printed, fused = EXPERIMENT.models.values()
    assert default.keywords == fused.keywords == {}
    assert printed.keywords == {"params": FlowDepthTracker.Params.paper()}


def test_table_counts_settled_frames(loop):
    """Shares and errors leave out the first second."""
    early = np.arange(FRAMES) < following_curves.SETTLING_FRAMES
    curve: FollowCurve = replace(
        loop,
        in_middle=~early,
        in_image=np.ones(FRAMES, np.bool_),
        directions=loop.angles + np.radians(np.where(early[:, None], 90, [[0.5, 0.25]])),
        overlaps=np.where(early, 0.0, 0.6),
    )
    row = following_curves.summarize([curve]).splitlines()[2].strip("| ").split(" | ")
    assert row[2:] == ["100.0%", "100%", "0.50", "0.50", "0.25", "0.25", "100%", "100%", "1"]


def test_csv_holds_every_frame(loop, tmp_path):
    """A line a frame, with angles in degrees."""
    following_curves.write_csv(tmp_path / "all.csv", [loop])
    lines = (tmp_path / "all.csv").read_text().splitlines()
    assert len(lines) == FRAMES + 1
    assert float(lines[1].split(",")[4]) == pytest.approx(np.degrees(loop.angles[0, 0]), abs=1e-3)
