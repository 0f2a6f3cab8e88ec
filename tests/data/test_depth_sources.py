# SPDX-License-Identifier: MIT
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Box
from tricue.data.open_source import open_source

from tests.data.depth_folders import color_folder, depth_folder, levels, meters


def test_a_folder_of_depth_alone(tmp_path: Path) -> None:
    """It proves that 16-bit images come as meters by the scale, NaN where they are 0, without color."""
    source = open_source(depth_folder(tmp_path / "walk", [1000, 2500]), depth_scale=0.001)
    assert (source.name, source.length, source.size) == ("walk", 2, (40, 30))
    first, second = source
    assert first.channels == second.channels == ("depth",)
    assert first.depth is not None
    assert first.depth.dtype == np.float32
    assert np.isnan(first.depth[0, 0])
    assert np.isnan(first.depth).sum() == 1
    assert meters(source) == pytest.approx([1.0, 2.5])


def test_a_real_unit_is_kept(tmp_path: Path) -> None:
    """It proves that the scale is what the meters are computed with, to float32's last bit."""
    source = open_source(depth_folder(tmp_path, [54321]), depth_scale=0.00025)
    assert meters(source) == [float(np.float32(54321) * np.float32(0.00025))]


@pytest.mark.parametrize("sub", ["img", "color", "left", "rgb"])
def test_depth_beside_color(tmp_path: Path, sub: str) -> None:
    """It proves that a folder's color/ and depth/ are two channels of one frame, of sizes of their own."""
    color_folder(tmp_path / sub, 2)
    depth_folder(tmp_path / "depth", [1500, 3000])
    source = open_source(tmp_path, depth_scale=0.001)
    assert levels(source) == [10, 20]
    assert meters(source) == pytest.approx([1.5, 3.0])
    frame = next(iter(source))
    assert frame.color is not None
    assert frame.depth is not None
    assert (frame.color.shape, frame.depth.shape) == ((48, 64, 3), (30, 40))


def test_depth_of_an_unknown_unit_is_left_out_with_a_note(tmp_path: Path) -> None:
    """It proves that color can still be tracked where depth/ has no known scale, and that this is said."""
    color_folder(tmp_path / "color", 2)
    depth_folder(tmp_path / "depth", [1500])  # fewer, which doesn't matter then
    source = open_source(tmp_path)
    assert list(source.channels) == ["color"]
    (note,) = source.notes
    assert note.startswith(f"left out {tmp_path / 'depth'}: depth_scale")


def test_a_second_folder_of_depth(tmp_path: Path) -> None:
    """It proves that --depth's folder is paired with color by order, whatever the files are called."""
    color_folder(tmp_path / "a", 2)
    depth = depth_folder(tmp_path / "b" / "raw", [700, 900])
    (tmp_path / "b" / "intrinsics.toml").touch()
    source = open_source(tmp_path / "a", depth=depth, depth_scale=0.001)
    assert levels(source) == [10, 20]
    assert meters(source) == pytest.approx([0.7, 0.9])
    assert source.calibration == tmp_path / "b" / "intrinsics.toml"


def color_video(path: Path, frames: int) -> Path:
    """An MJPG video."""
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (64, 48))
    for _ in range(frames):
        writer.write(np.full((48, 64, 3), 90, np.uint8))
    writer.release()
    return path


def test_depth_beside_a_video(tmp_path: Path) -> None:
    """It proves that a video's frames get depth and keep their times; a video of another length is an error
    at its end.
    """
    depth = depth_folder(tmp_path / "d", [700, 900, 1100])
    source = open_source(color_video(tmp_path / "v.avi", 3), depth=depth, depth_scale=0.001)
    assert source.length == 3
    assert [frame.timestamp for frame in source] == pytest.approx([0.0, 0.1, 0.2])
    assert meters(source) == pytest.approx([0.7, 0.9, 1.1])
    for frames, message in ((2, "got 2 color and more depth"), (4, "got 3 depth and more color")):
        longer = open_source(color_video(tmp_path / "w.avi", frames), depth=depth, depth_scale=0.001)
        with pytest.raises(ValueError, match=f"w: expected as many color as depth images, {message}"):
            list(longer)


def test_a_calibration_beside_the_images_is_found(tmp_path: Path) -> None:
    """It proves that intrinsics.toml is found in the sequence's folder first, then in the one above."""
    folder = depth_folder(tmp_path / "walk", [1000])
    assert open_source(folder, depth_scale=0.001).calibration is None
    for place in (tmp_path, folder):
        (place / "intrinsics.toml").touch()
        assert open_source(folder, depth_scale=0.001).calibration == place / "intrinsics.toml"


def test_real_depth(data: Path) -> None:
    """It proves that the real RGB-D sequences open with both channels, and that the true boxes' middles lie
    at the depths that their description gives.
    """
    for name, length in {"walk-away": 34, "queue-first": 24, "queue-second": 25}.items():
        source = open_source(data / "rgbd" / name)
        assert (source.length, list(source.channels), source.size) == (length, ["color", "depth"], (640, 480))
        assert source.calibration is not None
        assert source.truth is not None
        written = (data / "rgbd" / name / "position_z_mm.txt").read_text().split()
        apart = []
        for frame, box, z in zip(source, source.truth, map(float, written), strict=True):
            assert frame.color is not None
            assert frame.depth is not None
            if np.isfinite(box).all() and np.isfinite(z):
                x, y = (round(number) for number in Box(*box.tolist()).center)
                apart.append(abs(float(np.nanmedian(frame.depth[y - 9 : y + 9, x - 9 : x + 9])) - z / 1000))
        assert np.median(apart) < 0.15
