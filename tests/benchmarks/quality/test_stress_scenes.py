# SPDX-License-Identifier: MIT
import csv

import numpy as np
import pytest

from benchmarks.quality import stress_scenes


def test_only_visible_frames_count(scene_result):
    """Of overlaps and positions; the frame without a target counts as lost in AUROC."""
    line = dict(zip(stress_scenes.NUMBERS, stress_scenes.numbers_of([scene_result()]), strict=True))
    assert line["mean IoU"] == pytest.approx(0.8)
    assert line["IoU > 0.5"] == 1
    assert line["position, median m"] == pytest.approx(0.1)
    assert line["90 %"] == pytest.approx(0.18)
    assert line["with position"] == 1
    assert np.isnan(line["recovered"])
    assert (line["faithful"], line["AUROC"]) == (1, 1)


def test_each_kind_counts_the_same(scene_result):
    """In the mean of overlaps over kinds, though one has more scenes."""
    runs = [scene_result(), scene_result(), scene_result("fast", overlaps=(0.5, 0.1, 0.0))]
    assert stress_scenes.overall(runs)[0] == pytest.approx((0.8 + 0.3) / 2)
    assert stress_scenes.numbers_of(runs)[0] == pytest.approx((0.8 + 0.8 + 0.3) / 3)


def test_the_command_prints_and_writes(scene_result, monkeypatch, tmp_path, capsys):
    """A table per set of channels with a line per kind and tracker, and their mean."""
    made = {("color", "still-box"), ("depth", "still-box")}
    monkeypatch.setattr(
        stress_scenes,
        "run_scene",
        lambda task: [
            scene_result(task.kind)._replace(channels=task.channels, tracker=each.label)
            for each in task.variants
            if (task.channels, each.label) in made
        ],
    )
    words = ["--trackers", "still-box", "fused", "--kinds", "fast", "plain", "--channels", "depth", "color"]
    assert stress_scenes.main([*words, "--seeds", "0:2", "--csv", str(tmp_path / "o.csv")]) == 0
    printed = capsys.readouterr().out
    assert printed.index("color\n\n| kind") < printed.index("depth\n\n| kind")
    lines = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert [(line["channels"], line["kind"]) for line in lines] == [
        (channels, kind) for channels in ("color", "depth") for kind in ("plain", "fast", "mean")
    ]
    assert {float(line["mean IoU"]) for line in lines} == {0.8}
    assert {line["LOST reported"] for line in lines} == {""}
    head = "".join(f" {name} |" for name in list(lines[0])[1:])
    assert f"|{head}\n" in printed
