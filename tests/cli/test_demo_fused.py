# SPDX-License-Identifier: MIT
from functools import partial
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Box, Frame, Status, Track
from tricue.cli import main
from tricue.cli.demos import fused
from tricue.cli.outputs import Step
from tricue.scenes.stress.scene import stress_scene

pytest.importorskip("matplotlib", reason="the plot needs matplotlib: pip install tricue[demo]")

SHORT = {
    "color": (partial(stress_scene, "hidden", size=(120, 90), channels="rgbd"), ("color",)),
    "both": (partial(stress_scene, "plain", size=(120, 90), channels="rgbd"), ("color", "depth")),
    "pair": (partial(stress_scene, "plain", size=(120, 90), channels="stereo"), ("color", "right")),
}


def test_demo_writes_a_table_a_video_and_a_plot(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that every entry runs with its channels, is measured, and the files are written."""
    monkeypatch.setattr(fused, "ENTRIES", SHORT)
    assert main(["demo", "fused", "--output", str(tmp_path), "--seed", "1"]) == 0
    printed = capsys.readouterr().out
    rows = {line.split()[0]: line.split()[1:] for line in printed.splitlines() if line.split(" ")[0] in SHORT}
    assert list(rows) == list(SHORT)
    for overlap, held, *_ in rows.values():
        assert float(overlap) > 0.5
        assert float(held.removesuffix("%")) > 50
    assert rows["color"][2:4] == ["-", "-"]
    hidden = stress_scene("hidden", 1, (120, 90))
    assert rows["color"][4].endswith(f"/{(hidden.visible < 0.15).sum()}")
    assert cv2.imread(str(tmp_path / "fused.png")) is not None
    capture = cv2.VideoCapture(str(tmp_path / "fused.mp4"))
    assert sum(1 for _ in iter(lambda: capture.read()[0], False)) == len(hidden.frames) + 120 + 120


def test_the_picture_is_there_without_color_and_without_truth() -> None:
    """It proves that depth alone makes a picture of the same size, and that the true box is only drawn where
    there is one.
    """
    track = Track(Box(20, 20, 30, 30), 1.0, Status.TRACKED)
    depth = np.full((90, 120), 2.0, np.float32)
    depth[30:60, 40:80] = 1.0
    for frame in (Frame(np.zeros((90, 120, 3), np.uint8)), Frame(depth=depth)):
        known = fused._picture(Step(1, frame, track, 0.1), np.array([50.0, 40, 20, 20]), "here")
        unknown = fused._picture(Step(1, frame, track, 0.1), np.full(4, np.nan), "here")
        assert known.shape == unknown.shape
        assert (known != unknown).any()
