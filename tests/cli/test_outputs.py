# SPDX-License-Identifier: MIT
import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Frame, Status, Track
from tricue.cli.outputs import CsvOutput, JsonOutput, Step, VideoOutput
from tricue.draw.canvas import STATUS_COLORS
from tricue.draw.status_strip import AHEAD
from tricue.export.table import COLUMNS

IMAGE = np.zeros((8, 8, 3), np.uint8)
FLAT = Step(0, Frame(IMAGE), Track(Box(1, 2, 3, 4), 0.5, Status.LOST), 0.1)
SOLID = Step(
    7,
    Frame(IMAGE, timestamp=0.25),
    Track(
        Box(1 / 3, -2, 3, 4),
        0.25,
        Status.TRACKED,
        np.array([0.1, 0.2, 3.0]),
        np.array([[1e-6, 2e-9, 3], [2e-9, 4, 5], [3, 5, 1 / 3e5]]),
        depth=3.0,
    ),
    0.1,
)
EXPECTED: list[list[Any]] = [
    [0, None, "lost", 0.5, 1.0, 2.0, 3.0, 4.0, *[None] * 10],
    [
        7,
        0.25,
        "tracked",
        0.25,
        0.333333,
        -2.0,
        3.0,
        4.0,
        0.1,
        0.2,
        3.0,
        1e-6,
        2e-9,
        3.0,
        4.0,
        5.0,
        3.33333e-6,
        3.0,
    ],
]


def test_csv(tmp_path: Path) -> None:
    """It proves that a CSV file has the promised columns, a row a frame, empty cells for what is absent."""
    with CsvOutput(tmp_path / "new" / "t.csv") as output:
        output.write(FLAT)
        output.write(SOLID)
    rows = list(csv.reader((tmp_path / "new" / "t.csv").read_text().splitlines()))
    covariance = "XX_m2,XY_m2,XZ_m2,YY_m2,YZ_m2,ZZ_m2"
    assert ",".join(rows[0]) == f"frame,time_s,status,score,x,y,width,height,X_m,Y_m,Z_m,{covariance},depth_m"
    assert rows[1:] == [["" if value is None else str(value) for value in row] for row in EXPECTED]


def test_json(tmp_path: Path) -> None:
    """It proves that a JSON file holds what the run was and the same rows, null for what is absent."""
    with JsonOutput(tmp_path / "t.json", {"seed": 3, "params": {"grid": (4, 5)}}) as output:
        output.write(FLAT)
        output.write(SOLID)
    content = json.loads((tmp_path / "t.json").read_text())
    assert content["seed"] == 3
    assert content["params"] == {"grid": [4, 5]}
    assert content["tracks"] == [dict(zip(COLUMNS, row, strict=True)) for row in EXPECTED]


def test_files_are_whole_after_an_error(tmp_path: Path) -> None:
    """It proves that both files are complete up to the last frame when the loop breaks off, even at once."""
    for count in (0, 1):
        with pytest.raises(KeyboardInterrupt):
            _interrupted(tmp_path, count)
        assert len((tmp_path / "t.csv").read_text().splitlines()) == 1 + count
        assert len(json.loads((tmp_path / "t.json").read_text())["tracks"]) == count


def depth(near: float) -> NDArray[np.float32]:
    """A ramp of depth from ``near`` to a meter behind it, 480x480."""
    return np.tile(np.linspace(near, near + 1, 480, dtype=np.float32), (480, 1))


def pictures(output: VideoOutput, steps: list[Step], monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """What is written for the steps, before it is encoded."""
    written: list[Any] = []
    monkeypatch.setattr(output._writer, "write", lambda picture, _: written.append(picture))
    for step in steps:
        output.write(step)
    return written


def test_a_tracker_of_depth_is_drawn_on_depth(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a step with objects, or without color, is drawn on the depth; any other on the color."""
    color = np.full((480, 480, 3), (200, 10, 10), np.uint8)
    both, track = Frame(color, depth(1.0)), Track(Box(100, 100, 50, 60), 0.5, Status.TRACKED)
    steps = [
        Step(0, both, track, 0.1),
        Step(1, both, track, 0.1, objects=[Box(300, 300, 20, 20)]),
        Step(2, Frame(depth=depth(1.0)), track, 0.1),
    ]
    on_color, on_depth, alone = pictures(VideoOutput(tmp_path / "o.mp4", 5.0), steps, monkeypatch)
    assert tuple(on_color[450, 450]) == (200, 10, 10)
    assert tuple(on_depth[450, 450]) == tuple(alone[450, 450]) != (200, 10, 10)
    assert tuple(on_depth[300, 310]) != tuple(alone[300, 310])  # the object's edge
    for picture in (on_color, on_depth, alone):
        assert tuple(picture[130, 100]) == STATUS_COLORS[Status.TRACKED]


def test_shades_change_slowly(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that something that comes near changes the shades of the rest little by little, and a frame
    in which nothing was measured not at all.
    """
    track = Track(Box(100, 100, 50, 60), 0.5, Status.TRACKED)
    near = depth(3.0)
    near[:, :100] = 0.5
    nothing = np.full((480, 480), np.nan, np.float32)
    frames = [depth(3.0), near, nothing, depth(3.0)]
    steps = [Step(index, Frame(depth=frame), track, 0.1) for index, frame in enumerate(frames)]
    output = VideoOutput(tmp_path / "o.mp4", 5.0)
    first, second, black, last = (p[400, 300].astype(int) for p in pictures(output, steps, monkeypatch))
    assert 0 < np.abs(second - first).max() < 40
    assert black.tolist() == [0, 0, 0]
    assert np.abs(last - first).max() < 40


def test_strips_show_when_a_target_started(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that the strip of a target that started later is dark up to there."""
    frame, track = Frame(np.full((480, 480, 3), 255, np.uint8)), Track(Box(9, 9, 50, 60), 0.5, Status.TRACKED)
    steps = [
        Step(2, frame, track, 0.1, tracks={1: track}),
        Step(3, frame, track, 0.1, tracks={1: track, 2: track}),
    ]
    _, last = pictures(VideoOutput(tmp_path / "o.mp4", 5.0, length=4, first=1), steps, monkeypatch)
    tracked = STATUS_COLORS[Status.TRACKED]
    assert [tuple(last[-1, x].tolist()) for x in range(60, 480, 120)] == [AHEAD, tracked, tracked, AHEAD]
    assert [tuple(last[-9, x].tolist()) for x in range(60, 480, 120)] == [AHEAD, AHEAD, tracked, AHEAD]


def test_the_overlay_has_the_frames_times(tmp_path: Path) -> None:
    """It proves that frames with times are shown at these, and those without at the rate."""
    av = pytest.importorskip("av")
    for name, seconds, expected in (
        ("timed", [7.0, 7.1, 9.0, 9.25], [0, 0.1, 2, 2.25]),
        ("plain", [None] * 4, [0, 0.2, 0.4, 0.6]),
    ):
        steps = [
            FLAT._replace(number=index, frame=Frame(IMAGE, timestamp=time))
            for index, time in enumerate(seconds, 5)
        ]
        with VideoOutput(tmp_path / f"{name}.mp4", 5.0) as output:
            for step in steps:
                output.write(step)
        with av.open(str(tmp_path / f"{name}.mp4")) as file:
            assert [frame.time for frame in file.decode(video=0)] == pytest.approx(expected)


def _interrupted(folder: Path, count: int) -> None:
    with CsvOutput(folder / "t.csv") as table, JsonOutput(folder / "t.json", {"seed": 3}) as objects:
        for _ in range(count):
            table.write(SOLID)
            objects.write(SOLID)
        raise KeyboardInterrupt
