# SPDX-License-Identifier: MIT
import csv

import numpy as np
import pytest

from benchmarks.quality import lateral_errors
from benchmarks.quality.lateral_errors import Errors

FRAMES = 4000


def made_up(name, share, seed, unit=1.0):
    """A target whose errors have a variance of 0.01 m² and that of a share of some side, m²."""
    rng = np.random.default_rng(seed)
    units = np.full((FRAMES, 2), unit)
    variance = np.full((FRAMES, 2), 0.01)
    return Errors(name, rng.normal(0, np.sqrt(variance + share**2 * units)), variance, units)


def test_the_share_is_found():
    """The most likely one is that by which errors were drawn, whatever the targets' sizes."""
    targets = [made_up(str(seed), 0.3, seed, unit=1.0 + seed) for seed in range(4)]
    assert lateral_errors.most_likely_share(targets) == pytest.approx(0.3, rel=0.05)


def test_each_target_is_judged_by_the_others():
    """One that is off by more than the others isn't in the share that judges it."""
    *others, odd = lateral_errors.rows(
        [*(made_up(str(seed), 0.2, seed) for seed in range(3)), made_up("odd", 0.8, 9)]
    )[:4]
    assert float(odd[-1]) == pytest.approx(0.2, rel=0.05)
    assert all(float(row[-1]) > 0.3 for row in others)


def test_seeds_are_one_target_and_few_frames_none():
    """Frames of one name are pooled; a target with few of them is left out."""
    few = Errors("few", *(np.ones((lateral_errors.MIN_FRAMES - 1, 2)) for _ in range(3)))
    found = lateral_errors.pool([made_up("a", 0.1, 0), few, made_up("b", 0.1, 1), made_up("a", 0.1, 2)])
    assert [(each.target, len(each.off)) for each in found] == [("a", 2 * FRAMES), ("b", FRAMES)]


def test_the_command_measures_recordings_and_scenes(walk, monkeypatch, tmp_path, capsys):
    """A recorded walker, whose position is the true box's middle, and rendered ones have a line each."""
    monkeypatch.setattr(lateral_errors, "ROOM_KINDS", ())
    monkeypatch.setattr(lateral_errors, "MIN_FRAMES", 5)
    assert lateral_errors.main([str(walk), "--seeds", "0:1", "--csv", str(tmp_path / "o.csv")]) == 0
    assert capsys.readouterr().out.startswith("most likely share: 0.")
    recorded, *scenes, mean = csv.DictReader((tmp_path / "o.csv").read_text().splitlines())
    assert recorded["target"] == "walk"
    assert max(map(float, recorded["error, mm"].split(","))) < 60  # two pixels of a person of 40 are 67 mm
    assert [row["target"] for row in scenes] == ["scene, walker", "scene, crossing"]
    assert int(mean["frames"]) == sum(int(row["frames"]) for row in (recorded, *scenes))


def test_a_folder_without_sequences_is_told(tmp_path, capsys):
    """It proves that wrong arguments end with the exit code of such."""
    with pytest.raises(SystemExit):
        lateral_errors.main([str(tmp_path)])
    assert str(tmp_path) in capsys.readouterr().err
