# SPDX-License-Identifier: MIT
import numpy as np
import pytest

from benchmarks.quality import sequences
from benchmarks.quality.cues import motion, search


def test_flow_alone_needs_no_depth(patrol):
    """On color alone it follows what moves, from all seven starts."""
    frames, boxes = patrol
    sequence = sequences.Sequence("patrol", frames, np.array(boxes))
    scores, fps = search.measure(motion.makers()["flow-depth, flow alone"], sequence)
    assert len(scores) == 7
    assert scores[0].success > 0.9
    assert fps > 0


def test_missing_sequence_is_named(tmp_path, capsys):
    """A sequence that isn't in the folder is refused by name, and by the module's."""
    with pytest.raises(SystemExit):
        motion.main([str(tmp_path)])
    error = capsys.readouterr().err
    assert f"expected some with true boxes under {tmp_path}, got 'Crossing'" in error
    assert "cues.motion" in error


def test_recorded_walker_is_followed_for_a_while(data):
    """Flow alone stays longer on a pedestrian than a box that never moves, though not to the end."""
    sequence = sequences.load(data / "color" / "Crossing")
    makers = motion.makers()
    auc = {
        name: np.mean([score.auc for score in search.measure(makers[name], sequence)[0]])
        for name in ("flow-depth, flow alone", "still-box")
    }
    assert auc["flow-depth, flow alone"] > 0.25
    assert auc["still-box"] < 0.1
