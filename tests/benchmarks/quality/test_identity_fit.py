# SPDX-License-Identifier: MIT
import csv

import numpy as np
import pytest
from tricue.track.fused.identity import STRUCTURE, Weights

from benchmarks.quality import identity_fit
from benchmarks.quality.common.identity_samples import Kind, Samples


def made_up(seed):
    """Samples of which good ones have the fourth feature 0.4 higher; the others tell nothing."""
    rng = np.random.default_rng(seed)
    kinds = np.repeat(np.array(Kind, np.intp), [300, 50, 20, 30])
    features = rng.normal(0.5, 0.1, (400, 8))
    features[:300, 3] += 0.4
    return Samples(kinds, features)


def test_each_sequence_counts_the_same():
    """And each kind in it, as COUNTS says; lost samples less where they are few."""
    kinds = np.array([Kind.GOOD] * 3 + [Kind.COVERED] + [Kind.LOST] * 10 + [Kind.GOOD])
    sequences = np.array(["a"] * 14 + ["b"])
    weights = identity_fit.sample_weights(kinds, sequences)
    np.testing.assert_allclose(weights, [2 / 3] * 3 + [1.0] + [1 / 50] * 10 + [2.0])


def test_unused_features_stay_zero():
    """The one that tells good samples has the weight, where it is used."""
    samples = made_up(0)
    found = identity_fit.fit(samples, np.ones(400), STRUCTURE)
    assert found[:3].tolist() == [0.0, 0.0, 0.0]
    assert found[3] > 10 * np.abs(found[4:8]).max()
    without = identity_fit.fit(samples, np.ones(400), Weights((1, 1, 1, 0), (0, 0, 0, 0), 0))
    assert np.abs(without[:3]).max() < found[3] / 10


def test_numbers():
    """Of 100 good samples the threshold misses three."""
    kinds = np.repeat(np.array(Kind, np.intp), [100, 4, 2, 0])
    scores = np.concatenate([np.arange(100), [-0.5, -0.5, 1.5, 100], [2.5, 49.5]]) / 200 + 0.1
    numbers = identity_fit.numbers_of(kinds, scores)
    np.testing.assert_allclose(numbers[:2], [(100 + 100 + 98 + 0) / 400, (97 + 50) / 200])
    assert np.isnan(numbers[2])
    np.testing.assert_allclose(numbers[3:5], [0.25, 0.5])
    assert np.isnan(numbers[5])


def test_printed_weights_are_python():
    """The line can be put into identity.py."""
    line = identity_fit.source_line("FOUND", np.array([0, 1.52, 7.7, 13.1, 0.24, 5, -0.01, 7.9, -4.68]))
    assert line == "FOUND = Weights((0.0, 1.5, 7.7, 13.1), (0.2, 5.0, 0.0, 7.9), -4.7)"


def test_the_command_fits_and_judges(monkeypatch, folders, tmp_path, capsys):
    """On made-up samples, of which one feature tells nearly all. A single recording can't be judged."""
    monkeypatch.setattr(identity_fit, "collect", lambda task: made_up(len(task.entry.name)))
    assert identity_fit.main([str(folders), "--csv", str(tmp_path / "o.csv")]) == 0
    printed = capsys.readouterr().out
    assert "APPEARANCE = Weights((0.0, " in printed
    assert "STRUCTURE = Weights((0.0, 0.0, 0.0, " in printed
    assert "samples: 900 good, 150 covered, 60 lost, 90 elsewhere" in printed
    lines = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert [line["weights"] for line in lines] == ["APPEARANCE", "STRUCTURE"]
    assert min(float(line["AUROC covered"]) for line in lines) > 0.98
    with pytest.raises(SystemExit):
        identity_fit.main([str(folders), "--only", "there"])
    assert "expected those of two recordings or more" in capsys.readouterr().err
