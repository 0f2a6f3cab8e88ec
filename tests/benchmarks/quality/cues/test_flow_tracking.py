# SPDX-License-Identifier: MIT
import numpy as np
import pytest

from benchmarks.quality.common import perturbed_starts, sequences
from benchmarks.quality.cues import flow_tracking


def test_flow_alone_needs_no_depth(patrol):
    """On color alone it follows what moves, from all seven starts."""
    frames, boxes = patrol
    sequence = sequences.Sequence("patrol", frames, np.array(boxes))
    scores, fps = perturbed_starts.measure(flow_tracking.makers()["flow-depth, flow alone"], sequence)
    assert len(scores) == 7
    assert scores[0].success > 0.9
    assert fps > 0


def test_missing_sequence_is_named(tmp_path, capsys):
    """A missing sequence is named in the error, and so is the script."""
    with pytest.raises(SystemExit):
        flow_tracking.main([str(tmp_path)])
    error = capsys.readouterr().err
    assert f"expected some with true boxes under {tmp_path}, got 'Crossing'" in error
    assert "cues.flow_tracking" in error


def test_recorded_walker_is_followed_for_a_while(data):
    """Flow alone stays longer on a pedestrian than a box that never moves, though not to the end."""
    sequence = sequences.load(data / "color" / "Crossing")
    makers = flow_tracking.makers()
    auc = {
        name: np.mean([score.auc for score in perturbed_starts.measure(makers[name], sequence)[0]])
        for name in ("flow-depth, flow alone", "still-box")
    }
    assert auc["flow-depth, flow alone"] > 0.25
    assert auc["still-box"] < 0.1
