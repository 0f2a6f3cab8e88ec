# SPDX-License-Identifier: MIT
from functools import partial
from pathlib import Path

import cv2
import pytest
from tricue.cli.demos import depth
from tricue.cli import main
from tricue.scenes import crossing, walker

pytest.importorskip("matplotlib", reason="the plot needs matplotlib: pip install tricue[demo]")

SHORT = {"alone": partial(walker, frames=6), "hidden": partial(crossing, frames=45)}


def test_demo_writes_a_table_a_video_and_a_plot(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the depth tracker runs through every scene, is measured, and the files are written."""
    monkeypatch.setattr(depth, "SCENES", SHORT)
    assert main(["demo", "depth-particle", "--output", str(tmp_path), "--seed", "1"]) == 0
    printed = capsys.readouterr().out
    rows = {line.split()[0]: line.split()[1:] for line in printed.splitlines() if line[:6].strip() in SHORT}
    assert list(rows) == list(SHORT)
    for overlap, error, _, high, *_ in rows.values():
        assert float(overlap) > 0.5
        assert float(error) < 15
        assert float(error) <= float(high)
    hidden = int((crossing(seed=1, frames=45).visible < 0.15).sum())
    assert rows["hidden"][5].endswith(f"/{hidden}")
    assert cv2.imread(str(tmp_path / "depth-particle.png")) is not None
    capture = cv2.VideoCapture(str(tmp_path / "depth-particle.mp4"))
    assert sum(1 for _ in iter(lambda: capture.read()[0], False)) == 6 + 45
