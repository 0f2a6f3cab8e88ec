# SPDX-License-Identifier: MIT
import csv

import numpy as np
import pytest

from benchmarks.quality import degraded_video
from benchmarks.quality.common.degradations import DEGRADATIONS
from benchmarks.quality.common.recordings import Recording
from benchmarks.quality.common.sequence_runs import find_tasks
from benchmarks.quality.common.variants import parse_variants


@pytest.mark.parametrize("change", DEGRADATIONS)
def test_boxes_are_judged_as_if_nothing_was_changed(folders, change):
    """A box that stays at its place has the same overlaps in a smaller image, and after a first box of
    another size; where frames are left out, those of the frames that are seen.
    """
    (task,) = find_tasks(parse_variants(["still-box"]), folders, ["there"])
    recording = Recording(task.entry.open())
    run = degraded_video.run_degraded(task.variants[0], recording, DEGRADATIONS[change])
    moved = 2 * np.arange(0, 20, DEGRADATIONS[change].step)
    assert run.overlaps == pytest.approx((40 - moved) / (40 + moved))


def test_the_command_prints_and_writes(folders, tmp_path, capsys):
    """A row per change and tracker, in the order of the changes; unknown ones and sequences are named."""
    words = [str(folders), "--only", "there", "back", "--trackers", "fused", "still-box"]
    words += ["--changes", "blur", "gray", "--csv", str(tmp_path / "o.csv")]
    assert degraded_video.main(words) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split(" | ")[:3] for line in lines[2:]] == [
        [f"| {change}", tracker, "2"] for change in ("blur", "gray") for tracker in ("fused", "still-box")
    ]
    found = list(csv.DictReader((tmp_path / "o.csv").read_text().splitlines()))
    assert len(found) == 2 * 2 * 2
    aucs = {(each["tracker"], each["change"]): float(each["AUC"]) for each in found}
    assert aucs["fused", "blur"] > 0.7 > aucs["still-box", "blur"]
    with pytest.raises(SystemExit):
        degraded_video.main([str(folders), "--only", "nowhere"])
    with pytest.raises(SystemExit):
        degraded_video.main([str(folders), "--changes", "upside-down"])
    assert "upside-down" in capsys.readouterr().err
