# SPDX-License-Identifier: MIT
"""Folders of depth that can't be read: the error names what is wrong."""

from collections.abc import Callable
from pathlib import Path
from time import sleep

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue.data.open_source import Source, open_source

from tests.data.depth_folders import (
    CHANNELS,
    beside,
    color_folder,
    depth_folder,
    ptb,
    tum,
    vot,
    write_color,
    write_depth,
)


@pytest.mark.parametrize("make", [lambda f: tum(f, [1.0], [1.0]), lambda f: tum(f, [], [1.0]), ptb])
def test_fps_beside_recorded_times_is_refused(tmp_path: Path, make: Callable[[Path], Path]) -> None:
    """It proves that TUM's and Princeton's images keep their own times, also a single one."""
    with pytest.raises(ValueError, match=r"^fps=15: expected with images without times"):
        open_source(make(tmp_path), fps=15)


def eight_bits(folder: Path) -> Path:
    """A color picture of depth."""
    write_color(folder / "1.png")
    return folder


def gray_bits(folder: Path) -> NDArray[np.uint8]:
    """An 8-bit gray image."""
    image = np.full((30, 40), 90, np.uint8)
    folder.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(folder / "1.png"), image)
    return image


def wide_bits(folder: Path) -> None:
    """A 16-bit color image."""
    folder.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(folder / "1.png"), np.full((30, 40, 3), 9000, np.uint16))


def meters_as_floats(folder: Path) -> Path:
    """A folder of color, and of depth in meters."""
    color_folder(folder / "color", 1)
    (folder / "depth").mkdir()
    cv2.imwrite(str(folder / "depth" / "1.tiff"), np.full((48, 64), 1.5, np.float32))
    return folder


def cut_off(folder: Path) -> Source:
    """A folder of depth whose second image ends in the middle."""
    depth_folder(folder, [1000, 1000])
    (folder / "2.png").write_bytes((folder / "2.png").read_bytes()[:60])
    return open_source(folder, depth_scale=0.001)


def eight_bits_in_the_middle(folder: Path) -> Source:
    """A folder of depth whose second image is a picture."""
    write_color(depth_folder(folder, [1000]) / "2.png")
    return open_source(folder, depth_scale=0.001)


def unlisted(folder: Path) -> Source:
    """A TUM folder whose list names a file that isn't there."""
    (tum(folder, [], [1.0, 2.0]) / "depth" / "2.000000.png").unlink()
    return open_source(folder)


def misspelt(line: str) -> Callable[[Path], Source]:
    """A TUM folder with a bad line in its list."""

    def opened(folder: Path) -> Source:
        (tum(folder, [], [1.0]) / "depth.txt").write_text(f"# list\n{line}\n")
        return open_source(folder)

    return opened


def uneven_vot(folder: Path) -> Source:
    """A VOT folder with one depth image too many."""
    write_depth(vot(folder, CHANNELS) / "depth" / "3.png", 1000)
    return open_source(folder)


@pytest.mark.parametrize(
    ("opened", "message"),
    [
        (
            lambda f: open_source(depth_folder(f / "walk", [1])),
            r"walk: expected depth_scale, the meters per unit .*; 0\.001 where they are .*8 bits",
        ),
        (
            lambda f: open_source(color_folder(f / "c", 1), depth=depth_folder(f / "d", [1])),
            "d: expected depth_scale",
        ),
        (
            lambda f: open_source(depth_folder(f, [1]), depth_scale=0),
            "depth_scale: expected meters per unit above 0, got 0",
        ),
        (
            lambda f: open_source(color_folder(f / "c", 3), depth=depth_folder(f / "d", [1]), depth_scale=1),
            "c: expected as many color as depth images, got 3 color and 1 depth",
        ),
        (uneven_vot, "expected as many color as depth images, got 2 color and 3 depth"),
        (
            lambda f: open_source(color_folder(f, 1), depth_scale=0.001),
            "expected depth images where depth_scale is given, found only color",
        ),
        (beside(eight_bits), r"1.png: expected depth, 16 bits .*, got uint8 \(48, 64, 3\); .* not meters"),
        (beside(gray_bits), r"1.png: .* got uint8 \(30, 40\); 8 bits are a picture of the depth, not meters"),
        (beside(wide_bits), r"1.png: expected depth, 16 bits of one channel, got uint16 \(30, 40, 3\)"),
        (
            lambda f: next(iter(open_source(meters_as_floats(f), depth_scale=1))),
            r"1.tiff: expected depth, 16 bits .*, got float32 \(48, 64\); write meters as millimeters into",
        ),
        (eight_bits_in_the_middle, "expected images of one kind, found 1 of color and 1 of depth"),
        (cut_off, "2.png: expected an image, this file can't be read as one"),
        (beside(lambda f: f.mkdir()), "d: expected a folder of images or a sequence, found neither"),
        (
            beside(lambda f: color_folder(f / "img", 1)),
            "d: expected a folder of 16-bit images of depth, found only",
        ),
        (beside(lambda f: None), "d: there is no such file or folder"),
        (beside(lambda f: f.write_text("x")), "d: expected a folder of 16-bit images of depth, got a file"),
        (
            lambda f: open_source(depth_folder(f / "a", [1]), depth=f / "a", depth_scale=1),
            "a: expected color images beside depth=.*, found only depth",
        ),
        (unlisted, "2.000000.png: there is no such file"),
        (misspelt("1.0"), "depth.txt, line 2: expected a timestamp and a file name, got '1.0'"),
        (misspelt("one depth/1.png"), "depth.txt, line 2: expected a timestamp"),
        (misspelt("nan depth/1.png"), "depth.txt, line 2: expected a timestamp"),
        (misspelt("# nothing"), "depth.txt: expected a line of timestamp and file name an image, found none"),
        (
            lambda f: open_source(tum(f, [1.0], [2.0])),
            "expected color and depth images within 0.02 s of each other, found none",
        ),
        (
            lambda f: open_source(vot(f, "channels.color=color/%08d.png\nchannels.depth=d/%08d.png\n")),
            "sequence: expected channels.depth=depth/%08d.png, got 'd/%08d.png'",
        ),
    ],
)
def test_bad_depth_is_named(tmp_path: Path, opened: Callable[[Path], Source], message: str) -> None:
    """It proves that each unusable input is an error that names the place and what is wrong with it."""
    with pytest.raises((ValueError, OSError), match=message):
        list(opened(tmp_path))


def test_a_cut_off_image_is_one_error(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """It proves that of an image that ends in the middle only the exception tells: libpng keeps quiet."""
    path = tmp_path / "1.png"
    noise = np.random.default_rng(0).integers(500, 4000, (120, 160)).astype(np.uint16)
    cv2.imwrite(str(path), noise)
    path.write_bytes(path.read_bytes()[:10_000])
    with pytest.raises(ValueError, match=r"1\.png: expected an image"):
        list(open_source(tmp_path))
    assert capfd.readouterr() == ("", "")


def test_a_camera_has_no_depth_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a live camera can't be paired with recorded depth."""

    class Endless:
        def __init__(self, _number: int) -> None:
            pass

        def isOpened(self) -> bool:  # noqa: N802 (as cv2 names it)
            return True

        def get(self, _key: int) -> float:
            return 0.0

        def read(self) -> tuple[bool, object]:
            sleep(0.01)
            return True, np.zeros((48, 64, 3), np.uint8)

        def release(self) -> None:
            pass

    monkeypatch.setattr(cv2, "VideoCapture", Endless)
    assert open_source("0").size == (64, 48)
    with pytest.raises(ValueError, match=r"^depth=.*: expected with a video or a folder, got camera 0"):
        open_source("0", depth=depth_folder(tmp_path, [1]), depth_scale=0.001)
