# SPDX-License-Identifier: MIT
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.data.files import image_paths, natural_order, video_paths
from tricue.data.layouts import read_layout
from tricue.draw.video import OverlayWriter


def test_digits_that_are_no_numbers() -> None:
    """It proves that names may have digits of any script, and such as ② and ³, which int() refuses."""
    names = ["10.png", "2.png", "2³4.png", "①/1.png", "٣/1.png", "photo 2².png", "photo 10².png"]
    found = [path.name for path in natural_order(map(Path, names))]
    assert found.index("2.png") < found.index("10.png")
    assert found.index("photo 2².png") < found.index("photo 10².png")


def test_images_in_natural_order(tmp_path: Path) -> None:
    """It proves that 2.png is before 10.png, and that hidden files and others are left out."""
    for name in ("10.png", "2.PNG", ".1.png", "1.txt", "③.png"):
        (tmp_path / name).touch()
    assert [path.name for path in image_paths(tmp_path)] == ["2.PNG", "10.png", "③.png"]


def test_times_in_names() -> None:
    """It proves that seconds since 1970 are in order, however many decimals each name has."""
    names = ["cam 9/1700000000.123.png", "cam 9/1700000000.5.png", "cam 10/1700000000.25.png"]
    names += ["cam 10/1700000000.9999999.png", "cam 10/1700000001.0.png"]
    assert [str(path) for path in natural_order(map(Path, reversed(names)))] == names


@pytest.mark.parametrize(
    ("names", "found"),
    [
        (["o.gif"], ["o.gif"]),
        (["o.ts", "notes.txt", ".hidden.ts"], ["o.ts"]),
        (["o.flv", "p.3GP"], ["o.flv", "p.3GP"]),
        (["o.mp4", "preview.gif", "german.ts", "._o.mp4"], ["o.mp4"]),
        (["notes.txt"], []),
    ],
)
def test_videos_of_a_folder(tmp_path: Path, names: list[str], found: list[str]) -> None:
    """It proves that a suffix that isn't only a video's counts where there is no other video."""
    for name in names:
        (tmp_path / name).touch()
    (tmp_path / "folder.ts").mkdir()
    assert [path.name for path in video_paths(tmp_path)] == found


@pytest.mark.parametrize("suffix", [".gif", ".ts", ".flv", ".3gp"])
def test_a_folder_with_any_video(tmp_path: Path, suffix: str) -> None:
    """It proves that a folder's one video is read as it is alone; FFmpeg looks into it, not at its name."""
    with OverlayWriter(tmp_path / "o.avi", 10.0) as writer:
        writer.write(np.full((48, 64, 3), 90, np.uint8))
    (tmp_path / "o.avi").rename(tmp_path / f"o{suffix}")
    if not cv2.VideoCapture(str(tmp_path / f"o{suffix}")).isOpened():
        pytest.skip("this OpenCV goes by names")
    layout = read_layout(tmp_path, None)
    assert (layout.format, len(list(layout.channels["color"]))) == ("video", 1)
