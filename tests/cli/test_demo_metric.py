# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue import Box, Status, Track
from tricue.cli.demos.metric import SceneResult
from tricue.cli.steps import RunClock
from tricue.scenes import crossing, walker


def test_errors_are_the_distance_from_the_truth() -> None:
    """It proves that errors are in meters, and not a number where there is no position."""
    scene = walker(seed=1, frames=2)
    places = [scene.positions[0] + [0.03, 0, 0.04], None]
    tracks = [Track(box, 1.0, Status.TRACKED, place) for box, place in zip(scene.boxes, places, strict=True)]
    result = SceneResult(scene, tracks, RunClock(tracking=0.5, updates=40))
    np.testing.assert_allclose(result.errors, [0.05, np.nan])
    np.testing.assert_allclose(result.overlaps, 1.0)
    assert result.speed == pytest.approx(80)


def test_hidden_frames_are_counted() -> None:
    """It proves that what is said counts in the frames in which the target is hidden, and in no others."""
    scene = crossing(seed=1, frames=45)
    hidden = np.flatnonzero(scene.visible < 0.15)
    statuses = [Status.OCCLUDED if index <= hidden[1] else Status.LOST for index in range(45)]
    result = SceneResult(scene, [Track(Box(0, 0, 1, 1), 1.0, status) for status in statuses])
    assert len(hidden) > 2
    assert result.count_hidden(Status.OCCLUDED) == f"2/{len(hidden)}"
    assert result.count_hidden(Status.OCCLUDED, Status.LOST) == f"{len(hidden)}/{len(hidden)}"
    assert result.count_hidden(Status.TRACKED) == f"0/{len(hidden)}"
    assert 0 < result.seen.sum() <= 45 - len(hidden)
