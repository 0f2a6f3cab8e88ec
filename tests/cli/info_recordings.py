# SPDX-License-Identifier: MIT
"""Small recordings of known contents, and what ``tricue info`` says of them."""

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tricue.cli import main


def color(folder: Path, count: int, digits: int = 8) -> Path:
    """A folder of 64x48 images, numbered from 1."""
    folder.mkdir(parents=True, exist_ok=True)
    for number in range(1, count + 1):
        cv2.imwrite(str(folder / f"{number:0{digits}}.png"), np.full((48, 64, 3), 90, np.uint8))
    return folder


def depth(folder: Path, count: int, rotated: bool = False) -> Path:
    """A folder of depth: 1000 to 1099 in equal parts, and a quarter of the pixels without."""
    folder.mkdir(parents=True, exist_ok=True)
    image = np.zeros((40, 100), np.uint16)
    image[:30] = np.arange(1000, 1100)
    for number in range(1, count + 1):
        if rotated:
            name, written = f"d-{number}000-{number}.png", image << 3 | image >> 13
        else:
            name, written = f"{number:08}.png", image
        cv2.imwrite(str(folder / name), written)
    return folder


def vot(folder: Path, count: int = 4) -> Path:
    """VOT RGB-D of ``count`` frames at 5 a second, with boxes for three, one of them absent."""
    color(folder / "color", count)
    depth(folder / "depth", count)
    lines = "fps=5\nchannels.color=color/%08d.png\nchannels.depth=depth/%08d.png\n"
    (folder / "sequence").write_text(lines)
    (folder / "groundtruth.txt").write_text("1,2,10,20\nnan,nan,nan,nan\n1,2,12.5,24\n")
    return folder


def kitti(root: Path) -> Path:
    """KITTI's tracking layout of three frames with two targets."""
    for side in ("image_02", "image_03"):
        color(root / side / "0000", 3, 6)
    rows = [(1, 0, "Car"), (2, 0, "Car"), (2, 3, "Van"), (3, 3, "Van")]
    (root / "label_02").mkdir()
    (root / "label_02" / "0000.txt").write_text(
        "".join(f"{frame} {track} {kind} 0 0 0 10 10 20 30 1 1 1 0 1 9 0\n" for frame, track, kind in rows)
    )
    return root


def facts(capsys: pytest.CaptureFixture[str], *arguments: object) -> Any:
    """What ``tricue info --json`` says."""
    assert main(["info", *map(str, arguments), "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def lines(capsys: pytest.CaptureFixture[str], *arguments: object) -> list[str]:
    """What ``tricue info`` prints."""
    assert main(["info", *map(str, arguments)]) == 0
    return capsys.readouterr().out.splitlines()
