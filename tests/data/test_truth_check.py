# SPDX-License-Identifier: MIT
"""What looks wrong about true boxes; tests/evaluation/test_dataset.py has the missing images."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.cli import main
from tricue.data.open_source import open_source
from tricue.data.source import Source
from tricue.data.truth_check import find_doubts

SIZE = (160, 120)


def images(folder: Path, count: int = 10) -> Path:
    """A folder of noise."""
    folder.mkdir(parents=True, exist_ok=True)
    noise = np.random.default_rng(0).integers(0, 256, (*SIZE[::-1], 3), np.uint8)
    for number in range(count):
        cv2.imwrite(str(folder / f"{number}.png"), noise)
    return folder


def doubts(source: Source) -> list[str]:
    """The doubts about a source of images."""
    return list(find_doubts(source, SIZE, source.length))


def numbered(numbers: range) -> str:
    """A table of boxes in the frames of these numbers."""
    return "frame,x,y,w,h\n" + "".join(f"{number},20,30,24,30\n" for number in numbers)


def test_frames_that_count_from_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A table of frames 1 to 10 of 10 images is doubtful, also to the commands; track says where to start."""
    table = images(tmp_path) / "boxes.csv"
    table.write_text(numbered(range(1, 11)))
    told = (
        "the table's last frame is 10, but frames count from 0, up to 9; if the table counts from 1, subtra"
    )
    (found,) = doubts(open_source(tmp_path))
    assert found.startswith(told)
    assert main(["info", str(tmp_path)]) == 0
    assert told in capsys.readouterr().out
    assert main(["track", str(tmp_path)]) == 2
    assert capsys.readouterr().err.endswith(
        "; the next true box is that of frame 1: --start 1, or give --box x,y,width,height\n"
    )
    assert main(["track", str(tmp_path), "--start", "1"]) == 0
    assert told in capsys.readouterr().out
    for numbers in (range(10), range(1, 10), range(12), range(2, 12)):
        table.write_text(numbered(numbers))
        assert doubts(open_source(tmp_path)) == [], numbers
    table.write_text(numbered(range(1, 11)).replace("1,", "0,,,,\n1,", 1))  # absent in the first one
    assert doubts(open_source(tmp_path)) == []


def test_frames_of_a_video_that_count_from_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its frames are known at its end."""
    writer = cv2.VideoWriter(str(tmp_path / "a.avi"), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, SIZE)
    for _ in range(10):
        writer.write(cv2.imread(str(images(tmp_path / "img", 1) / "0.png")))
    writer.release()
    (tmp_path / "a.csv").write_text(numbered(range(1, 11)))
    for end, told in (((), 1), (("--end", "5"), 0)):
        assert main(["track", str(tmp_path / "a.avi"), "--box", "20,30,24,30", *end]) == 0
        assert capsys.readouterr().out.count("the table's last frame is 10") == told


def moving(shift: int = 0) -> np.ndarray:
    """Boxes (20, 4) of a target that moves through most of the image."""
    steps = np.arange(20)[:, np.newaxis]
    return np.array([20, 30, 24, 30]) + steps * [4, 1, 0, 0] + [shift, 0, 0, 0]


def test_corners_in_place_of_sizes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Corners x1, y1, x2, y2 are told where they can't be boxes, also by the commands."""
    place, boxes = images(tmp_path, 20), moving()
    corners = np.concatenate([boxes[:, :2], boxes[:, :2] + boxes[:, 2:]], axis=1)
    np.savetxt(place / "groundtruth.txt", corners, "%d", ",")
    told = "2 true boxes reach far beyond the image, 160x120 px, but would fit it as corners x1,y1,x2,y2; "
    (found,) = doubts(open_source(place))
    assert found.startswith(told)
    for command in ("info", "track"):
        assert main([command, str(place)]) == 0
        assert told in capsys.readouterr().out


@pytest.mark.parametrize(
    "boxes",
    [moving(), moving(40), moving(-40), np.full((20, 4), [10, 5, 160, 120]), np.full((20, 4), np.nan)],
    ids=["inside", "leaves on the right", "leaves on the left", "a close-up", "absent"],
)
def test_boxes_are_no_corners(tmp_path: Path, boxes: np.ndarray) -> None:
    """Targets that leave the image, or fill it, are no reason for doubt."""
    np.savetxt(images(tmp_path, 20) / "groundtruth.txt", boxes, "%g", ",")
    assert doubts(open_source(tmp_path)) == []


def test_no_real_box_is_doubtful(data: Path) -> None:
    """Nor are the true boxes of real sequences."""
    for path in sorted(data.rglob("groundtruth*.txt"))[:6]:
        source = open_source(path.parent)
        stream = source.channels.get("color") or source.channels["depth"]
        assert not [*find_doubts(source, stream.size, source.length)], path
