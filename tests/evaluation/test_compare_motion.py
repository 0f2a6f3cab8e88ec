# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.evaluation import compare_motion, compare_search, sequences


def test_flow_alone_needs_no_depth(patrol):
    """On color alone it follows what moves, from all seven starts."""
    frames, boxes = patrol
    sequence = sequences.Sequence("patrol", frames, np.array(boxes), np.full(len(frames), np.nan))
    scores, fps = compare_search.measure(compare_motion.makers()["flow-depth, flow alone"], sequence)
    assert len(scores) == 7
    assert scores[0].success > 0.9
    assert fps > 0


def test_missing_sequence_is_named(tmp_path, capsys):
    """A sequence that isn't in the folder is refused by name, and by the module's."""
    with pytest.raises(SystemExit):
        compare_motion.main([str(tmp_path)])
    error = capsys.readouterr().err
    assert f"expected some with true boxes under {tmp_path}, got 'Crossing'" in error
    assert "compare_motion" in error


def test_recorded_walker_is_followed_for_a_while(data):
    """Flow alone stays longer on a pedestrian than a box that never moves, though not to the end."""
    sequence = sequences.load(data / "color" / "Crossing")
    makers = compare_motion.makers()
    auc = {
        name: np.mean([score.auc for score in compare_search.measure(makers[name], sequence)[0]])
        for name in ("flow-depth, flow alone", "still-box")
    }
    assert auc["flow-depth, flow alone"] > 0.25
    assert auc["still-box"] < 0.1
