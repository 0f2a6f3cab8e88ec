# SPDX-License-Identifier: MIT
import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tricue import Box, Frame, Status, Track
from tricue.commands.outputs import COLUMNS, CsvOutput, JsonOutput, Step

IMAGE = np.zeros((8, 8, 3), np.uint8)
FLAT = Step(0, Frame(IMAGE), Track(Box(1, 2, 3, 4), 0.5, Status.LOST), 0.1)
SOLID = Step(
    7,
    Frame(IMAGE, timestamp=0.25),
    Track(Box(1 / 3, -2, 3, 4), 0.25, Status.TRACKED, np.array([0.1, 0.2, 3.0])),
    0.1,
)
EXPECTED: list[list[Any]] = [
    [0, None, "lost", 0.5, 1.0, 2.0, 3.0, 4.0, None, None, None],
    [7, 0.25, "tracked", 0.25, 0.333333, -2.0, 3.0, 4.0, 0.1, 0.2, 3.0],
]


def test_csv(tmp_path: Path) -> None:
    """It proves that a CSV file has the promised columns, a row a frame, empty cells for what is absent."""
    with CsvOutput(tmp_path / "new" / "t.csv") as output:
        output.write(FLAT)
        output.write(SOLID)
    rows = list(csv.reader((tmp_path / "new" / "t.csv").read_text().splitlines()))
    assert ",".join(rows[0]) == "frame,time_s,status,score,x,y,width,height,X_m,Y_m,Z_m"
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


def _interrupted(folder: Path, count: int) -> None:
    with CsvOutput(folder / "t.csv") as table, JsonOutput(folder / "t.json", {"seed": 3}) as objects:
        for _ in range(count):
            table.write(SOLID)
            objects.write(SOLID)
        raise KeyboardInterrupt
