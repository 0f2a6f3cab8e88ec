# SPDX-License-Identifier: MIT
"""Starting on a face in video of one camera."""

import csv
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Box
from tricue.cli import main

FRAMES, FIRST_FACE = 5, 2
SIDE = 192


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A photograph with a face, after two frames of gray."""
    pytest.importorskip("skimage", reason="needs scikit-image's photograph: pip install tricue[demo]")
    from tricue.scenes.rendering.photographs import load_photograph

    portrait = cv2.resize(load_photograph("astronaut"), (SIDE, SIDE), interpolation=cv2.INTER_AREA)
    place = tmp_path / "video"
    place.mkdir()
    for index in range(FRAMES):
        image = portrait if index >= FIRST_FACE else np.full_like(portrait, 120)
        cv2.imwrite(str(place / f"{index:04}.png"), image)
    return place


@pytest.mark.parametrize("options", [["--detect", "face"], ["--tracker", "color-particle"]])
def test_the_first_face_is_waited_for(
    folder: Path, options: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that trackers start on the first face with --detect face, and color-particle without it."""
    from tricue.scenes.rendering.photographs import ASTRONAUT_FACE

    path = folder.parent / "o.csv"
    assert main(["track", str(folder), *options, "--csv", str(path)]) == 0
    assert f"started in frame {FIRST_FACE}" in capsys.readouterr().out
    row = next(csv.DictReader(path.read_text().splitlines()))
    box = Box(*(float(row[key]) for key in ("x", "y", "width", "height")))
    assert box.iou(Box(*(SIDE / 512 * value for value in ASTRONAUT_FACE))) > 0.5


@pytest.mark.parametrize("options", [["--detect", "face"], ["--tracker", "color-particle"]])
def test_no_face_is_an_error_in_a_line(
    folder: Path, options: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that where no frame shows a face, one line says so, and what to do."""
    for path in folder.glob("*.png"):
        cv2.imwrite(str(path), np.full((SIDE, SIDE, 3), 120, np.uint8))
    assert main(["track", str(folder), *options]) == 2
    error = capsys.readouterr().err
    assert "no face" in error
    assert error.endswith("give --box x,y,width,height\n")
    assert error.count("\n") == 1
