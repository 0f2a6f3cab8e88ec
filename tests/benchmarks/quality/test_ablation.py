# SPDX-License-Identifier: MIT
import csv

from benchmarks.quality import ablation
from benchmarks.quality.common import scene_runs
from benchmarks.quality.common.protocols import PROTOCOLS
from benchmarks.quality.common.variants import Inputs


def test_the_ablation_has_a_row_per_cue(scene_result, monkeypatch, folders, tmp_path, capsys):
    """All cues, without each, and no other row without cv2's CSRT; recordings and scenes side by side."""
    found = [each for each in ablation.ablated() if each.label != ablation.BASELINE]
    cues = found[0].make(Inputs(("color",)))._tracker.params.cues
    assert [each.label for each in found] == ["fused", *(f"without {cue}" for cue in cues)]
    for each in found[1:]:
        cut = each.make(Inputs(("color",)))._tracker.params.cues
        assert set(cues) - set(cut) == {each.label.removeprefix("without ")}
    monkeypatch.setattr(ablation, "ablated", lambda: found[:2])
    monkeypatch.setattr(
        scene_runs,
        "run_scene",
        lambda task: [
            scene_result(task.kind)._replace(tracker=e.label, channels=task.channels) for e in found
        ],
    )
    assert ablation.main([str(folders), "--seeds", "0:1", "--csv", str(tmp_path / "o.csv")]) == 0
    lines = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert [line[""] for line in lines] == ["fused", found[1].label]
    assert {float(line["stereo"]) for line in lines} == {0.8}
    assert all(float(line[protocol]) > 0 for line in lines for protocol in PROTOCOLS)
    assert "| fused |" in capsys.readouterr().out
