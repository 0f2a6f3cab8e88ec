# SPDX-License-Identifier: MIT
import json

import numpy as np
import pytest

from benchmarks.quality.common import saved_runs
from benchmarks.quality.common.frame_results import FrameResults
from benchmarks.quality.common.protocols import ORDERS, PROTOCOLS
from benchmarks.quality.common.sequence_runs import SequenceResult
from benchmarks.quality.common.variants import parse_variants


@pytest.fixture
def result():
    """A run of three frames in each order but the last, each with another overlap; one has no truth."""
    runs = {
        order: FrameResults(
            np.array([1.0, share, np.nan]),
            np.zeros(3, np.bool_),
            np.array([1.0, 0.8, 0.8]),
            np.ones(3, np.bool_),
            np.array([np.nan, 1e-3, 1e-3]),
            *[np.full(3, np.nan)] * 2,
        )
        for order, share in zip(ORDERS[:-1], np.linspace(0.05, 0.95, 8), strict=True)
    }
    return SequenceResult("fused", "Couple", runs)


def test_saved_numbers_come_back(result, tmp_path):
    """To the last bit; a protocol without runs isn't there. The file says with which parameters they were
    reached, and has null where a number is unknown.
    """
    path = tmp_path / "new" / "runs.json"
    variants = parse_variants(["fused"], ["fused.ridge=0.5"])
    saved_runs.save(path, variants, [result, SequenceResult("fused", "deep", {}, "no depth")])
    found = saved_runs.load(path)
    assert found == {"fused": saved_runs.aucs([result])}
    assert found["fused"]["Couple"].keys() == PROTOCOLS.keys() - {"third"}
    stored = json.loads(path.read_text())
    assert stored["trackers"]["fused"]["ridge"] == 0.5
    assert len(stored["runs"]) == 1 + 1 + 8
    first, second = stored["runs"][:2]
    assert [first[name] for name in ("tracker", "sequence", "protocol")] == ["fused", "Couple", "forward"]
    assert [first[name] for name in ("start", "backward", "step", "frames")] == [0, False, 1, 3]
    assert (first["lost"], first["auroc"], first["deviation"]) == (0.5, 1, pytest.approx(0.8))
    assert (second["backward"], second["lost"], second["auroc"]) == (True, 0, None)


@pytest.mark.parametrize("text", ["", "[]", '{"runs": [{"tracker": "fused"}]}'])
def test_other_files_are_named(text, tmp_path):
    """What isn't JSON, or has no runs."""
    (tmp_path / "runs.json").write_text(text)
    with pytest.raises(ValueError, match=r"runs\.json: expected runs as --save writes them"):
        saved_runs.load(tmp_path / "runs.json")
