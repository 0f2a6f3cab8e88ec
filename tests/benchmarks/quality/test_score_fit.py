# SPDX-License-Identifier: MIT
import csv
import re

import numpy as np
import pytest
from tricue.evaluation.protocols import Order
from tricue.track.fused.identity import SCORE_OFFSET, SCORE_SLOPE, score_of

from benchmarks.quality import score_fit
from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.sequence_runs import SequenceResult

FRAMES = 20_000
LINE = 0.6, -0.4


def made_up(seed, slope, offset):
    """A run whose frames are on target as often as a line over their log-odds says."""
    rng = np.random.default_rng(seed)
    log_odds = rng.normal(0, 3, FRAMES)
    hit = rng.random(FRAMES) < 1 / (1 + np.exp(-(slope * log_odds + offset)))
    nothing = np.full(FRAMES, np.nan)
    scores = np.array([score_of(each) for each in log_odds])
    overlaps, absent = np.where(hit, 0.8, 0.0), np.zeros(FRAMES, np.bool_)
    return FrameResults(overlaps, absent, scores, hit, np.ones(FRAMES), nothing, nothing)


def test_the_line_is_found():
    """What was drawn by a line is fitted by it, from scores that another one gave."""
    frames = made_up(0, *LINE)
    found = score_fit.fit(score_fit.log_odds(frames.scores), frames.overlaps)
    np.testing.assert_allclose(found, LINE, atol=0.04)


def test_first_frames_are_left_out():
    """Their box is given; frames without truth are, too, but for those that say that there is no target."""
    frames = made_up(0, 1.0, 0.0)
    frames.seconds[0] = np.nan
    frames.overlaps[1:3] = np.nan
    frames.absent[2] = True
    assert len(score_fit.known(frames).scores) == FRAMES - 2


def test_the_command_fits_and_judges(monkeypatch, folders, tmp_path, capsys):
    """Scores in use that are far off become right by lines of the other recordings."""
    runs = [made_up(seed, *LINE) for seed in range(3)]
    results = [SequenceResult("fused", f"video{i}", {Order(): run}) for i, run in enumerate(runs)]
    monkeypatch.setattr(score_fit, "run_sequences", lambda tasks, jobs: results)
    assert score_fit.main([str(folders), "--csv", str(tmp_path / "o.csv")]) == 0
    printed = re.match(r"SCORE_SLOPE, SCORE_OFFSET = ([-.\d]+), ([-.\d]+)", capsys.readouterr().out)
    assert printed is not None
    np.testing.assert_allclose([float(each) for each in printed.groups()], LINE, atol=0.04)
    lines = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert [line["runs"] for line in lines] == 2 * ["all", "forward", "starts"]
    assert lines[1] == {**lines[0], "runs": "forward"}
    used, left_out = lines[0], lines[3]
    assert float(used["deviation"]) > 0.2
    assert float(left_out["deviation"]) < 0.05
    assert float(left_out["AUROC"]) == pytest.approx(float(used["AUROC"]), abs=0.01)


def test_a_single_recording_cannot_be_judged(monkeypatch, folders, capsys):
    """It is said, and the exit code is that of wrong arguments."""
    run = made_up(0, SCORE_SLOPE, SCORE_OFFSET)
    results = [SequenceResult("fused", "video", {Order(): run})]
    monkeypatch.setattr(score_fit, "run_sequences", lambda tasks, jobs: results)
    with pytest.raises(SystemExit):
        score_fit.main([str(folders)])
    assert "expected those of two recordings or more" in capsys.readouterr().err
