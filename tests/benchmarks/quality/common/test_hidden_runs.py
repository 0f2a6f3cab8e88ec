# SPDX-License-Identifier: MIT
import numpy as np

from benchmarks.quality.common.hidden_runs import HIDINGS, run_hidden, run_sequence, to_and_fro
from benchmarks.quality.common.sequence_runs import find_tasks
from benchmarks.quality.common.variants import parse_variants


def test_a_sequence_is_played_to_and_fro():
    """Its ends aren't repeated; backward it starts at the end."""
    assert to_and_fro(4, 9, backward=False).tolist() == [0, 1, 2, 3, 2, 1, 0, 1, 2]
    assert to_and_fro(4, 5, backward=True).tolist() == [3, 2, 1, 0, 1]


def test_what_is_always_tracked_is_wrong(folders):
    """A still box is TRACKED in all hidden frames, and taken up where the target stays. A moving target that
    was lost before it was hidden doesn't count.
    """
    (task,) = find_tasks(parse_variants(["still-box"]), folders, ["there"])
    opened = task.entry.open()
    frames, truth = list(opened.source), opened.truth(20)
    still = np.tile(truth[0], (20, 1))
    for hiding in HIDINGS:
        result = run_hidden(task.variants[0], opened, frames, still, hiding)
        assert (result.wrong_frames, result.taken_up) == (hiding.frames, True)
        assert run_hidden(task.variants[0], opened, frames, truth, hiding) is None


def test_the_target_is_taken_up_again(folders):
    """By the fused tracker, which sees nothing else in the noise; each way of hiding is a run."""
    (task,) = find_tasks(parse_variants(["fused", "stereo-head"]), folders, ["there"])
    results = run_sequence(task)
    assert [each.hiding for each in results] == list(HIDINGS)
    assert {each.tracker for each in results} == {"fused"}
    assert all(each.taken_up for each in results if each.hiding.kind == "empty")
    assert max(each.wrong_frames for each in results) <= 5
