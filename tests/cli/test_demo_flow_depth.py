# SPDX-License-Identifier: MIT
from functools import partial
from pathlib import Path

import cv2
import pytest
from tricue.cli.demos import flow_depth
from tricue.cli import main
from tricue.scenes import overtaking

pytest.importorskip("matplotlib", reason="the plot needs matplotlib: pip install tricue[demo]")

SHORT = {
    "both": (partial(overtaking, frames=32), {}),
    "flow": (partial(overtaking, frames=8), {"cues": ("flow",)}),
    "depth": (partial(overtaking, frames=8, depth=True), {}),
}


def test_demo_writes_a_table_a_video_and_a_plot(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that every entry runs with its cues, is measured, and the files are written."""
    monkeypatch.setattr(flow_depth, "ENTRIES", SHORT)
    assert main(["demo", "flow-depth", "--output", str(tmp_path), "--seed", "1"]) == 0
    printed = capsys.readouterr().out
    rows = {line.split()[0]: line.split()[1:] for line in printed.splitlines() if line.split(" ")[0] in SHORT}
    assert list(rows) == list(SHORT)
    for overlap, held, *_ in rows.values():
        assert float(overlap) > 0.5
        assert float(held.removesuffix("%")) > 50
    assert rows["flow"][2] == "-"
    assert float(rows["both"][2]) < 0.5
    assert float(rows["depth"][2]) < 0.5
    hidden = int((overtaking(seed=1, frames=32).visible < 0.15).sum())
    assert hidden > 0
    assert rows["both"][4].endswith(f"/{hidden}")
    assert cv2.imread(str(tmp_path / "flow-depth.png")) is not None
    capture = cv2.VideoCapture(str(tmp_path / "flow-depth.mp4"))
    assert sum(1 for _ in iter(lambda: capture.read()[0], False)) == 32 + 8 + 8
