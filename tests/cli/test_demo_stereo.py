# SPDX-License-Identifier: MIT
from functools import partial
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Box, Status, Track
from tricue.cli.demos import stereo
from tricue.cli.demos.metric import Result
from tricue.cli import main
from tricue.scenes import head

pytest.importorskip("matplotlib", reason="the plot needs matplotlib: pip install tricue[demo]")

SHORT = {"jumping": partial(head, frames=12, kind="jump"), "hidden": partial(head, frames=50, kind="hidden")}


def test_demo_writes_a_table_a_video_and_a_plot(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the stereo tracker runs through every scene, is measured, and the files are written."""
    monkeypatch.setattr(stereo, "SCENES", SHORT)
    assert main(["demo", "stereo-head", "--output", str(tmp_path), "--seed", "1"]) == 0
    printed = capsys.readouterr().out
    rows = {line.split()[0]: line.split()[1:] for line in printed.splitlines() if line.split(" ")[0] in SHORT}
    assert list(rows) == list(SHORT)
    for overlap, held, median, _, high, _, *_ in rows.values():
        assert float(overlap) > 0.5
        assert float(held.removesuffix("%")) > 50
        assert float(median) < 4
        assert float(median) <= float(high)
    hidden = int((head(seed=1, frames=50, kind="hidden").visible < 0.15).sum())
    assert hidden > 0
    assert rows["hidden"][6].endswith(f"/{hidden}")
    assert cv2.imread(str(tmp_path / "stereo-head.png")) is not None
    capture = cv2.VideoCapture(str(tmp_path / "stereo-head.mp4"))
    assert sum(1 for _ in iter(lambda: capture.read()[0], False)) == 12 + 50


def test_errors_are_shares_of_the_distance() -> None:
    """It proves that an error of a hundredth of the way to the head is 1 %."""
    scene = head(seed=1, frames=2)
    tracks = [Track(Box(0, 0, 9, 9), 1.0, Status.TRACKED, 1.01 * place) for place in scene.positions]
    np.testing.assert_allclose(stereo.shares(Result(scene, tracks)), 1.0)
