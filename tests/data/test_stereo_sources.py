# SPDX-License-Identifier: MIT
import time
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import StereoRig
from tricue.data.live import LiveStream
from tricue.data.open_source import Source, open_source
from tricue.data.summary import summarize_calibration

KITTI = "P2: 700 0 31 45 0 700 23 0.2 0 0 1 0.003\nP3: 700 0 31 -333 0 700 23 2 0 0 1 0.003\n"

GRAY_KITTI = "\nP0: 700 0 31 0 0 700 23 0 0 0 1 0\nP1: 700 0 31 -350 0 700 23 0 0 0 1 0\n"


def images(folder: Path, first: int, count: int = 3, width: int = 64) -> Path:
    """A folder whose images are of the levels first, first + 10, ..."""
    folder.mkdir(parents=True)
    for index in range(count):
        picture = np.full((48, width, 3), first + 10 * index, np.uint8)
        cv2.imwrite(str(folder / f"{index:06d}.png"), picture)
    return folder


def video(path: Path, first: int, frames: int) -> Path:
    """An MJPG video whose frames have the levels first, first + 10, ..."""
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 12.0, (64, 48))
    for index in range(frames):
        writer.write(np.full((48, 64, 3), first + 10 * index, np.uint8))
    writer.release()
    return path


def levels(source: Source) -> list[tuple[int, int]]:
    """The mean levels of left and right in each frame."""
    pairs = [(frame.color, frame.right) for frame in source]
    return [
        (round(float(left.mean())), round(float(right.mean())))
        for left, right in pairs
        if left is not None and right is not None
    ]


PAIRS = [(10, 110), (20, 120), (30, 130)]


def test_two_folders(tmp_path: Path) -> None:
    """It proves that --right's images are paired with the left ones by order, and times are the left's."""
    left, right = images(tmp_path / "a", 10), images(tmp_path / "b", 110)
    source = open_source(left, right=right, fps=10.0)
    assert (source.length, source.size, source.fps) == (3, (64, 48), 10.0)
    assert levels(source) == PAIRS
    assert [frame.timestamp for frame in source] == pytest.approx([0, 0.1, 0.2])


def test_left_and_right_in_one_folder(tmp_path: Path) -> None:
    """It proves that left/ and right/ of a sequence are a pair, with the sequence's true boxes."""
    images(tmp_path / "left", 10)
    images(tmp_path / "right", 110)
    (tmp_path / "groundtruth.txt").write_text("1,2,3,4\n")
    source = open_source(tmp_path)
    assert levels(source) == PAIRS
    assert source.first_box == (1, 2, 3, 4)


def test_two_videos(tmp_path: Path) -> None:
    """It proves that videos are paired frame by frame, at the left one's rate."""
    source = open_source(video(tmp_path / "a.avi", 10, 3), right=video(tmp_path / "b.avi", 110, 3))
    assert source.fps == pytest.approx(12)
    for found, expected in zip(levels(source), PAIRS, strict=True):
        assert found == pytest.approx(expected, abs=2)


def kitti(root: Path, sequence: str = "0005") -> Path:
    """KITTI's tracking layout."""
    images(root / "image_02" / sequence, 10)
    images(root / "image_03" / sequence, 110)
    (root / "calib").mkdir(exist_ok=True)
    (root / "calib" / f"{sequence}.txt").write_text(KITTI)
    return root


@pytest.mark.parametrize("place", [".", "image_02/0005"])
def test_kitti_tracking(tmp_path: Path, place: str) -> None:
    """It proves that a sequence's pair and calibration are found from the root and from the left images."""
    source = open_source(kitti(tmp_path) / place)
    assert levels(source) == PAIRS
    assert source.calibration == tmp_path / "calib" / "0005.txt"


def test_kitti_tracking_has_its_rate(tmp_path: Path) -> None:
    """It proves that the rate of KITTI's cameras is known, though no file has it, and can be overridden."""
    source = open_source(kitti(tmp_path))
    assert (source.fps, source.knows_times) == (10.0, True)
    assert [frame.timestamp for frame in source] == pytest.approx([0.0, 0.1, 0.2])
    assert open_source(kitti(tmp_path / "other"), fps=25).fps == 25


def test_kitti_with_several_sequences(tmp_path: Path) -> None:
    """It proves that of several sequences one has to be named, and can be."""
    kitti(tmp_path, "0001")
    kitti(tmp_path, "0005")
    with pytest.raises(ValueError, match=r"one sequence, got 2 \(0001, 0005\); name one, .*0001"):
        open_source(tmp_path)
    assert open_source(tmp_path / "image_02" / "0005").calibration == tmp_path / "calib" / "0005.txt"


@pytest.mark.parametrize("place", ["00", "00/image_2"])
def test_kitti_odometry(tmp_path: Path, place: str) -> None:
    """It proves that image_2, image_3 and calib.txt are a pair."""
    images(tmp_path / "00" / "image_2", 10)
    images(tmp_path / "00" / "image_3", 110)
    (tmp_path / "00" / "calib.txt").write_text(KITTI)
    source = open_source(tmp_path / place)
    assert levels(source) == PAIRS
    assert source.calibration == tmp_path / "00" / "calib.txt"


@pytest.mark.parametrize(
    ("left", "right", "inner"), [("image_0", "image_1", ""), ("image_00", "image_01", "data")]
)
def test_gray_kitti(tmp_path: Path, left: str, right: str, inner: str) -> None:
    """It proves that without color the gray images are a pair, with their own calibration."""
    for side, first in ((left, 10), (right, 110)):
        images(tmp_path / "00" / side / inner, first)
    (tmp_path / "00" / "calib.txt").write_text(KITTI + GRAY_KITTI)
    source = open_source(tmp_path / "00")
    assert levels(source) == PAIRS == levels(open_source(tmp_path / "00" / left / inner))
    found = summarize_calibration(source, None)
    assert found is not None
    assert found["baseline_m"] == pytest.approx(0.5)


def test_color_kitti_before_gray(tmp_path: Path) -> None:
    """It proves that of a sequence with both the color images are taken, with their calibration."""
    for name, first in (("image_0", 50), ("image_1", 60), ("image_2", 10), ("image_3", 110)):
        images(tmp_path / name, first)
    (tmp_path / "calib.txt").write_text(KITTI + GRAY_KITTI)
    source = open_source(tmp_path)
    assert levels(source) == PAIRS
    found = summarize_calibration(source, None)
    assert found is not None
    assert found["baseline_m"] == pytest.approx(0.54)


def test_kitti_raw(tmp_path: Path) -> None:
    """It proves that image_02/data is read, with the calibration of the day's folder."""
    drive = tmp_path / "2011_09_26" / "drive_0001_sync"
    images(drive / "image_02" / "data", 10)
    images(drive / "image_03" / "data", 110)
    (drive.parent / "calib_cam_to_cam.txt").write_text(KITTI)
    source = open_source(drive)
    assert levels(source) == PAIRS
    assert source.calibration == drive.parent / "calib_cam_to_cam.txt"


def test_kitti_without_right_images(tmp_path: Path) -> None:
    """It proves that the left images alone are a color sequence, as most downloads have them."""
    images(tmp_path / "image_02" / "0005", 10)
    source = open_source(tmp_path)
    assert list(source.channels) == ["color"]
    assert source.calibration is None


def test_right_overrides_what_lies_beside(tmp_path: Path) -> None:
    """It proves that --right is taken where the folder has a right of its own, too."""
    source = open_source(kitti(tmp_path / "k"), right=images(tmp_path / "other", 200))
    assert levels(source) == [(10, 200), (20, 210), (30, 220)]


def test_pairs_are_rectified(tmp_path: Path) -> None:
    """It proves that a source with ``rectify`` gives what it makes of each pair."""
    source = open_source(images(tmp_path / "a", 10), right=images(tmp_path / "b", 110))

    def swap(
        left: NDArray[np.uint8], right: NDArray[np.uint8]
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
        return right, left

    swapped = Source(source.name, source.channels, rectify=swap)
    assert levels(swapped) == [(right, left) for left, right in PAIRS]


class LevelCamera:
    """A cv2.VideoCapture that gives frames of its number's level."""

    def __init__(self, number: int) -> None:
        self.number = number

    def isOpened(self) -> bool:  # noqa: N802 (as cv2 names it)
        return True

    def get(self, _property: int) -> float:
        return 0.0

    def read(self) -> tuple[bool, object]:
        time.sleep(0.01)
        return True, np.full((48, 64, 3), 10 * self.number, np.uint8)

    def release(self) -> None:
        pass


def test_one_camera_is_no_pair(tmp_path: Path) -> None:
    """It proves that the left images aren't taken as the right ones, too, by whatever name."""
    left = images(tmp_path / "a", 10)
    for right in (left, str(left), tmp_path / "a" / ".." / "a"):
        with pytest.raises(ValueError, match=r"^right=.*a: expected other images than the left camera's"):
            open_source(left, right=right)
    with pytest.raises(ValueError, match=r"^right=rtsp://host/x: expected other images"):
        open_source("rtsp://me:word@host/x", right="rtsp://me:word@host/x")


def test_two_cameras(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """It proves that two cameras are a pair, with a word on their times; a camera and a folder are none."""
    monkeypatch.setattr(cv2, "VideoCapture", LevelCamera)
    source = open_source("1", right="2")
    assert isinstance(source.channels["right"], LiveStream)
    assert "don't expose at one time" in source.notes[0]
    frame = next(iter(source))
    assert frame.color is not None
    assert frame.right is not None
    assert (frame.color[0, 0, 0], frame.right[0, 0, 0]) == (10, 20)
    with pytest.raises(ValueError, match=r"^right=.*: expected two cameras or two recordings"):
        open_source("1", right=images(tmp_path / "a", 10))


def test_different_numbers_of_images_are_refused(tmp_path: Path) -> None:
    """It proves that both numbers are named: of images at once, of videos where the shorter one ends."""
    left, right = images(tmp_path / "a", 10), images(tmp_path / "b", 110, count=2)
    with pytest.raises(ValueError, match="as many color as right images, got 3 color and 2 right"):
        open_source(left, right=right)
    source = open_source(video(tmp_path / "a.avi", 10, 5), right=video(tmp_path / "b.avi", 10, 4))
    with pytest.raises(ValueError, match="as many color as right images, got 4 right and more color"):
        levels(source)


def test_an_empty_right_folder_is_refused(tmp_path: Path) -> None:
    """It proves that a right/ without images isn't taken for none."""
    images(tmp_path / "left", 10)
    (tmp_path / "right").mkdir()
    with pytest.raises(ValueError, match="got 3 color and 0 right"):
        open_source(tmp_path)


def test_different_sizes_are_refused(tmp_path: Path) -> None:
    """It proves that the frame is named, and both shapes."""
    source = open_source(images(tmp_path / "a", 10), right=images(tmp_path / "b", 110))
    cv2.imwrite(str(tmp_path / "b" / "000002.png"), np.zeros((48, 32, 3), np.uint8))
    shapes = r"\(48, 64, 3\), got \(48, 32, 3\)"
    with pytest.raises(ValueError, match=f"^frame 2: right: expected the shape of color, {shapes}"):
        levels(source)
    with pytest.raises(ValueError, match=r"^frame 2: right"):
        list(source.frames([2]))


def test_depth_is_no_pair(tmp_path: Path) -> None:
    """It proves that --right, and what it stands beside, have to be color images, and have to be there."""
    left = images(tmp_path / "a", 10)
    depth = tmp_path / "d"
    depth.mkdir()
    cv2.imwrite(str(depth / "0.png"), np.full((48, 64), 2000, np.uint16))
    with pytest.raises(ValueError, match=r"0\.001"):  # what depth needs first
        open_source(left, right=depth)
    with pytest.raises(ValueError, match=rf"{depth}: expected color images of a stereo pair"):
        open_source(depth, depth_scale=0.001, right=left)
    with pytest.raises(FileNotFoundError, match="nowhere: there is no such file or folder"):
        open_source(left, right=tmp_path / "nowhere")


def test_real_pairs(data: Path) -> None:
    """It proves both real sequences: their pairs, their number, and KITTI's calibration."""
    belt, cars = open_source(data / "stereo/conveyor-box"), open_source(data / "stereo/kitti-tracking")
    assert (belt.length, cars.length) == (152, 16)
    assert belt.first_box == (554, 122, 86, 50)
    for source in (belt, cars):
        frame = next(iter(source))
        assert frame.channels == ("color", "right")
        assert frame.color is not None
        assert frame.color.shape[1::-1] == source.size
    assert cars.calibration is not None
    assert StereoRig.from_kitti(cars.calibration, size=cars.size).baseline == pytest.approx(0.5327, abs=1e-4)
