# SPDX-License-Identifier: MIT
from functools import partial
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Box, Status, Track
from tricue.cli import main
from tricue.commands import demo_depth
from tricue.scenes import crossing, walker

pytest.importorskip("matplotlib", reason="the plot needs matplotlib: pip install tricue[demo]")

SHORT = {"alone": partial(walker, frames=6), "hidden": partial(crossing, frames=45)}


def test_demo_writes_a_table_a_video_and_a_plot(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the depth tracker runs through every scene, is measured, and the files are written."""
    monkeypatch.setattr(demo_depth, "SCENES", SHORT)
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


def test_errors_are_the_distance_from_the_truth() -> None:
    """It proves that errors are in centimetres, and not a number where there is no position."""
    scene = walker(seed=1, frames=2)
    places = [scene.positions[0] + [0.03, 0, 0.04], None]
    tracks = [Track(box, 1.0, Status.TRACKED, place) for box, place in zip(scene.boxes, places, strict=True)]
    result = demo_depth.Result(scene, tracks)
    np.testing.assert_allclose(result.errors, [5.0, np.nan])
    np.testing.assert_allclose(result.overlaps, 1.0)


def test_hidden_frames_are_counted() -> None:
    """It proves that OCCLUDED counts in the frames in which the target is hidden, and in no others."""
    scene = crossing(seed=1, frames=45)
    hidden = np.flatnonzero(scene.visible < 0.15)
    statuses = [Status.OCCLUDED if index <= hidden[1] else Status.TRACKED for index in range(45)]
    tracks = [Track(Box(0, 0, 1, 1), 1.0, status) for status in statuses]
    assert demo_depth.Result(scene, tracks).said == f"2/{len(hidden)}"
