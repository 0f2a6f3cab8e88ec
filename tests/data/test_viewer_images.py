# SPDX-License-Identifier: MIT
import time
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import open_source
from tricue.data.source import Source
from tricue.data.viewer_images import _by_name


def color(folder: Path, names: Sequence[str]) -> Path:
    """Color images of the levels 10, 20, ..."""
    for index, name in enumerate(names, 1):
        cv2.imwrite(str(folder / name), np.full((12, 16, 3), 10 * index, np.uint8))
    return folder


def depth(folder: Path, names: Sequence[str]) -> Path:
    """Depth of 1000, 2000, ... units."""
    for index, name in enumerate(names, 1):
        cv2.imwrite(str(folder / name), np.full((12, 16), 1000 * index, np.uint16))
    return folder


def found(source: Source) -> list[tuple[int, float]]:
    """The level and the depth of each frame."""
    return [
        (int(frame.color[0, 0, 0]), round(float(frame.depth[0, 0]), 6))
        for frame in source
        if frame.color is not None and frame.depth is not None
    ]


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ("rs_Color_{}.png", "rs_Depth_{}.png"),
        ("color-{:06d}.jpg", "depth-{:06d}.png"),
        ("frame-{:06d}.color.jpg", "frame-{:06d}.depth.png"),
        ("rgb_{}.png", "depth_{}.png"),
        ("{:04d}.jpg", "{:04d}.png"),
        ("left_rgb{:03d}.png", "left_depth{:03d}.png"),
    ],
)
def test_paired_by_number(tmp_path: Path, first: str, second: str) -> None:
    """It proves that names of several viewers give color with the depth of the same number, in its order."""
    numbers = (8, 9, 10, 11)
    color(tmp_path, [first.format(number) for number in numbers])
    depth(tmp_path, [second.format(number) for number in numbers])
    source = open_source(tmp_path, depth_scale=0.001)
    assert found(source) == [(10, 1.0), (20, 2.0), (30, 3.0), (40, 4.0)]
    assert (source.format, source.notes) == ("viewer's images", ())


@pytest.mark.parametrize(("per_second", "digits"), [(1.0, 6), (1e3, 3), (1e6, 0), (1e9, 0)])
def test_paired_by_time(tmp_path: Path, per_second: float, digits: int) -> None:
    """It proves that times in any unit pair the nearest within half a frame, and are the frames' times."""
    start, step = 1_623_072_394, 1 / 32
    times = [start + index * step for index in range(5)]
    color(tmp_path, [f"rs_Color_{time * per_second:.{digits}f}.png" for time in times])
    late = [time + 0.004 for time in times if time != times[2]]
    depth(tmp_path, [f"rs_Depth_{time * per_second:.{digits}f}.png" for time in late])
    source = open_source(tmp_path, depth_scale=0.001)
    assert found(source) == [(10, 1.0), (20, 2.0), (40, 3.0), (50, 4.0)]
    assert [frame.timestamp for frame in source] == pytest.approx(times[:2] + times[3:], abs=1e-3)
    assert source.notes == ("left out 1 of 5 color images, which have no partner",)


def test_a_long_recording_is_told_apart_at_once() -> None:
    """It proves that the time to tell color from depth grows as the number of images does."""
    paths = [Path(f"rs_{kind}_{number}.png") for kind in ("Color", "Depth") for number in range(8000)]
    begin = time.process_time()
    assert _by_name(paths) == (paths[:8000], paths[8000:])
    assert time.process_time() - begin < 2


def test_unpaired_images_are_told(tmp_path: Path) -> None:
    """It proves that images without partner and of other kinds are left out and counted."""
    color(tmp_path, ["Color_1.png", "Color_2.png", "Infrared_1.png"])
    depth(tmp_path, ["Depth_2.png", "Depth_3.png"])
    source = open_source(tmp_path, depth_scale=0.001)
    assert found(source) == [(20, 1.0)]
    assert source.notes == (
        "left out 1 of 2 color and 1 of 2 depth and 1 of 1 other images, which have no partner",
    )


def test_depth_of_an_unknown_unit(tmp_path: Path) -> None:
    """It proves that color alone is read without --depth-scale, and that this is told."""
    depth(color(tmp_path, ["Color_1.png", "Color_2.png"]), ["Depth_1.png", "Depth_2.png"])
    source = open_source(tmp_path)
    assert list(source.channels) == ["color"]
    assert [frame.color[0, 0, 0] for frame in source if frame.color is not None] == [10, 20]
    assert source.notes == (
        "left out Depth_1.png and others: depth_scale gives its meters per unit, 0.001 for millimeters",
    )


def test_pictures_of_depth(tmp_path: Path) -> None:
    """It proves that the colored pictures that RealSense's viewer saves as depth aren't taken for depth."""
    color(color(tmp_path, ["Color_1.png", "Color_2.png"]), ["Depth_1.png", "Depth_2.png"])
    source = open_source(tmp_path)
    assert list(source.channels) == ["color"]
    assert source.length == 2
    assert source.notes == ("left out Depth_1.png and others: 8 bits are a picture of depth",)
    with pytest.raises(ValueError, match="expected depth images where depth_scale is given"):
        open_source(tmp_path, depth_scale=0.001)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (["a.png", "b.png"], ["c.png", "d.png"]),
        (["1.png", "2.png"], ["3.png", "4.png"]),
        (["Color_1.png", "Color_2.png"], ["Depth_7.png", "Depth_8.png"]),
        (["1_Color_640.png", "2_Color_640.png"], ["1_Depth_640.png", "2_Depth_640.png"]),
    ],
)
def test_mixed_kinds_are_refused(tmp_path: Path, first: list[str], second: list[str]) -> None:
    """It proves that color and depth that nothing pairs aren't read as one sequence."""
    depth(color(tmp_path, first), second)
    with pytest.raises(ValueError, match="found 2 of color and 2 of depth whose names don't pair them"):
        open_source(tmp_path, depth_scale=0.001)


@pytest.mark.parametrize("make", [color, depth])
def test_one_kind_stays_a_plain_folder(tmp_path: Path, make: object) -> None:
    """It proves that names with "color" or "depth" alone don't make a folder another layout."""
    name = "Color" if make is color else "Depth"
    (color if make is color else depth)(tmp_path, [f"{name}_{number}.png" for number in range(3)])
    source = open_source(tmp_path, depth_scale=None if make is color else 0.001)
    assert (source.format, source.length) == ("images", 3)
