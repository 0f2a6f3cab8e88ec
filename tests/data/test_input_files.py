# SPDX-License-Identifier: MIT
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.data.input_files import input_files
from tricue.data.open_source import open_source
from tricue.draw.video import OverlayWriter

LABEL = "{} 0 Car 0 0 0 10 10 20 20 1 1 1 0 0 9 0\n"


def image(path: Path, depth: bool = False) -> None:
    """An image of color or of depth, and its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    shape, kind = ((48, 64), np.uint16) if depth else ((48, 64, 3), np.uint8)
    cv2.imwrite(str(path), np.full(shape, 99, kind))


def text(path: Path, content: str) -> None:
    """A text file, and its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(content)


def vot(folder: Path) -> None:
    """A sequence as VOT lays it out."""
    text(folder / "sequence", "channels.color=color/%08d.png\nfps=30\n")
    text(folder / "groundtruth.txt", "1,2,8,9\n")
    image(folder / "color" / "00000001.png")


def tum(folder: Path) -> None:
    """A sequence as TUM lays it out."""
    text(folder / "rgb.txt", "# times\n1.0 rgb/1.0.png\n")
    text(folder / "depth.txt", "1.0 depth/1.0.png\n")
    image(folder / "rgb" / "1.0.png")
    image(folder / "depth" / "1.0.png", depth=True)


def kitti(folder: Path) -> None:
    """A sequence as KITTI's tracking benchmark lays it out."""
    text(folder / "label_02" / "0005.txt", LABEL.format(0) + LABEL.format(1))
    for number in (0, 1):
        image(folder / "image_02" / "0005" / f"{number:06d}.png")


def one_video(folder: Path) -> None:
    """A folder with one video and its true boxes."""
    with OverlayWriter(folder / "clip.avi", 30.0) as writer:
        writer.write(np.full((48, 64, 3), 99, np.uint8))
    text(folder / "clip.csv", "x,y,width,height\n1,2,8,9\n")


@pytest.mark.parametrize(
    ("write", "names"),
    [
        (vot, ["sequence", "groundtruth.txt", "color/00000001.png"]),
        (tum, ["rgb.txt", "depth.txt", "rgb/1.0.png", "depth/1.0.png"]),
        (kitti, ["label_02/0005.txt", "image_02/0005/000001.png"]),
        (one_video, ["clip.avi", "clip.csv"]),
    ],
)
def test_what_a_layout_reads(tmp_path: Path, write, names: list[str]) -> None:
    """It proves that lists, labels, true boxes and images of a sequence count as read."""
    write(tmp_path)
    found = set(input_files(open_source(tmp_path), tmp_path))
    assert found == {*found, *(tmp_path / name for name in names)}
    assert all(path.is_file() for path in found)


def test_several_places(tmp_path: Path) -> None:
    """It proves that the lists of a folder of depth beside color are read, too."""
    image(tmp_path / "color" / "1.png")
    tum(tmp_path / "tum")
    source = open_source(tmp_path / "color", depth=tmp_path / "tum")
    found = set(input_files(source, tmp_path / "color", tmp_path / "tum"))
    assert {tmp_path / "color" / "1.png", tmp_path / "tum" / "depth.txt"} <= found
