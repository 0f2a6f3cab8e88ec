# SPDX-License-Identifier: MIT
import math
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Status, Track
from tricue.draw import STATUS_COLORS, OverlayWriter, overlay

BLACK = np.zeros((480, 640, 3), np.uint8)


BOX = Box(200, 300, 60, 80)


def track(box: Box = BOX, status: Status = Status.TRACKED) -> Track:
    """A track to draw."""
    return Track(box, 0.5, status)


@pytest.mark.parametrize("status", list(Status))
def test_the_box_is_where_it_should_be(status: Status) -> None:
    """It proves that all four edges of the box are drawn at its pixels in the color of the status."""
    picture = overlay(BLACK, track(status=status))
    for row, column in [(300, 230), (379, 230), (340, 200), (340, 259)]:
        assert tuple(picture[row, column]) == STATUS_COLORS[status]


def test_the_image_is_left_alone() -> None:
    """It proves that drawing works on a copy."""
    image = BLACK.copy()
    picture = overlay(image, track(), particles=[[230, 340]], truth=Box(190, 290, 60, 80), note="frame 1")
    assert np.array_equal(image, BLACK)
    assert picture.any()


def test_small_images_are_enlarged() -> None:
    """It proves that a small picture, grey or color, becomes a BGR one of readable size, box and all."""
    for image in (BLACK[:120, :160], BLACK[:120, :160, 0]):
        picture = overlay(image, track(Box(50, 75, 15, 20)))
        assert picture.shape == (480, 640, 3)
        assert tuple(picture[300, 230]) == STATUS_COLORS[Status.TRACKED]


def test_particles_are_dots() -> None:
    """It proves that each particle changes the pixels at its centre."""
    particles = np.array([[500.0, 100.0, 9, 9], [550.0, 120.0, 9, 9]])
    picture = overlay(BLACK, track(), particles=particles)
    for x, y, *_ in particles.astype(int):
        assert picture[y, x].any()


@pytest.mark.parametrize(
    "box", [Box(-50, -50, 20, 20), Box(600, 440, 900, 900), Box(1e6, -1e6, 1e6, 1e6), Box(3, 3, 0.01, 0.01)]
)
def test_boxes_anywhere_are_drawn(box: Box) -> None:
    """It proves that boxes outside, across the edge, huge or tiny don't disturb the drawing."""
    assert overlay(BLACK, track(box), particles=[[math.inf, 0], [-1e9, 1e9]]).shape == BLACK.shape


def _write_seven(writer: OverlayWriter, picture: NDArray[np.uint8]) -> None:
    with writer:
        for _ in range(7):
            writer.write(picture)
        raise KeyboardInterrupt


@pytest.mark.parametrize(("name", "width"), [("o.mp4", 64), ("o.avi", 64), ("new/o.MP4", 65)])
def test_videos_are_whole(tmp_path: Path, name: str, width: int) -> None:
    """It proves that what was written can be read again, every frame of it, after an interruption too."""
    picture = np.full((48, width, 3), 90, np.uint8)
    writer = OverlayWriter(tmp_path / name, 25.0)
    with pytest.raises(KeyboardInterrupt):
        _write_seven(writer, picture)
    capture = cv2.VideoCapture(str(writer.path))
    frames = []
    while (answer := capture.read())[0]:
        frames.append(answer[1])
    assert len(frames) == 7
    assert np.mean(frames) == pytest.approx(90, abs=4)


def test_a_missing_codec_falls_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that without mp4v an MJPG .avi of the same name is written, and no empty .mp4 stays."""
    real = cv2.VideoWriter

    class WithoutMp4:
        fourcc = staticmethod(real.fourcc)

        def __new__(cls, name: str, *rest: Any) -> Any:
            return real() if name.endswith(".mp4") else real(name, *rest)

    monkeypatch.setattr(cv2, "VideoWriter", WithoutMp4)
    with OverlayWriter(tmp_path / "o.mp4", 25.0) as writer:
        writer.write(np.zeros((48, 64, 3), np.uint8))
    assert writer.path == tmp_path / "o.avi"
    assert [path.name for path in tmp_path.iterdir()] == ["o.avi"]


def test_an_unused_writer_leaves_nothing(tmp_path: Path) -> None:
    """It proves that a writer that got no picture leaves no empty file behind."""
    with OverlayWriter(tmp_path / "o.mp4", 25.0):
        pass
    assert not list(tmp_path.iterdir())


def test_bad_names_are_refused(tmp_path: Path) -> None:
    """It proves that an unknown kind of file, or a place that can't be written, is an error at once."""
    with pytest.raises(ValueError, match=r"o\.gif: expected a video file's name that ends in \.mp4 or \.avi"):
        OverlayWriter(tmp_path / "o.gif", 25.0)
    (tmp_path / "o.mp4").mkdir()
    with pytest.raises(OSError, match="directory"):
        OverlayWriter(tmp_path / "o.mp4", 25.0)
