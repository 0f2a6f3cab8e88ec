# SPDX-License-Identifier: MIT
from functools import partial

import numpy as np
import pytest
from tricue import Box, FlowDepthTracker, Status, Track
from tricue.errors import NoDepthInBoxError
from tricue.papers.experiment import Case
from tricue.papers.okada import vergence, vergence_curves
from tricue.papers.okada.experiments import EXPERIMENTS
from tricue.scenes import overtaking

CASE = Case("m", "s", 0)
EXPERIMENT = EXPERIMENTS["okada-vergence"]


@pytest.fixture(scope="module")
def verged():
    """A pair verged by 2 degrees, in six frames."""
    return overtaking(0, frames=6, vergence=2.0)


def test_known_vergence_gives_the_depth(verged):
    """Told the angle, the tracker finds the target within 5 % of its distance; not told, it doesn't."""
    known, ignored = (
        vergence.measure(CASE, partial(vergence.make_tracker, known=each, printed=False), verged)
        for each in (True, False)
    )
    assert known.started
    assert np.nanmax(np.abs(known.depth_errors)) < 0.05 * verged.positions[0, 2]
    assert not (np.abs(ignored.depth_errors) < 0.3 * verged.positions[0, 2]).any()


def test_a_run_that_does_not_start_counts(verged):
    """A tracker that finds no disparity in the box has overlaps of 0 and no depth, and is LOST."""

    class Blind:
        traits = FlowDepthTracker.traits

        def init(self, frame, box):
            raise NoDepthInBoxError("box: nothing")

    curve = vergence.measure(CASE, lambda **_: Blind(), verged)
    assert not curve.started
    assert not curve.overlaps.any()
    assert np.isnan(curve.depth_errors).all()
    assert set(curve.statuses) == {Status.LOST}
    row = vergence_curves.summarize([curve]).splitlines()[2].split(" | ")
    assert row[2:] == ["0%", "-", "-", "-", "0%", "0%", "1 |"]


def test_errors_are_signed(verged):
    """A depth 0.1 m too large is an error of 0.1 m."""

    class Far:
        traits = FlowDepthTracker.traits

        def init(self, frame, box):
            self.index = -1
            return self.update(frame)

        def update(self, frame):
            self.index += 1
            at = verged.positions[self.index] + [0, 0, 0.1]
            return Track(Box(*verged.boxes[self.index]), 1.0, Status.TRACKED, at)

    curve = vergence.measure(CASE, lambda **_: Far(), verged)
    np.testing.assert_allclose(curve.depth_errors, 0.1)
    np.testing.assert_allclose(curve.overlaps, 1.0)
    assert vergence_curves.summarize([curve]).splitlines()[2].split(" | ")[3:6] == ["0.10", "0.10", "0.10"]


def test_models_are_the_default_and_the_paper():
    """Each is told the vergence, or isn't, and changes nothing else."""
    for make in EXPERIMENT.models.values():
        tracker = make(vergence=1.5)
        paper = make.keywords["printed"]
        expected = FlowDepthTracker.Params.paper() if paper else FlowDepthTracker.Params()
        told = 1.5 if make.keywords["known"] else 0.0
        assert tracker.params.vergence == told
        assert tracker.params.sigma == expected.sigma
        assert tracker.params.complete_occlusion == expected.complete_occlusion
