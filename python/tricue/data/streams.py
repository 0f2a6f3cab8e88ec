# SPDX-License-Identifier: MIT
"""Streams: the images of one channel in order, from a folder or a video file."""

import os
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

DEFAULT_FPS = 30.0
MAX_FPS = 1000.0
MIN_DECODED_SHARE = 0.95  # of the frames that a container states, which it does by its duration at times

Image = NDArray[Any]
ImageReader = Callable[[Path], Image]
TimedPaths = list[tuple[float, Path]]
"""Times in seconds, and the image files of these times."""


def read_color(path: Path) -> Image:
    """Read an image as BGR, (H, W, 3) uint8; ValueError or FileNotFoundError names the file."""
    return read_image(path, cv2.IMREAD_COLOR)


class Stream(Protocol):
    """Images with their times in seconds. Each iteration starts at the first one; a live camera goes on."""

    @property
    def fps(self) -> float:
        """Frames per second; 30 where the input doesn't say."""

    @property
    def timed(self) -> bool:
        """Whether the input has times or a frame rate."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the first image, pixels."""

    @property
    def length(self) -> int | None:
        """The number of images, None if it isn't known before reading them."""

    def __iter__(self) -> Iterator[tuple[float, Image]]: ...

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, Image]]:
        """Only the images with these increasing indices; ValueError for an index beyond the last image."""


@dataclass(frozen=True)
class Images:
    """Image files in the given order; the error of ``read`` names the first that can't be read.

    rate: frames per second, None where unknown. times: seconds, one per image; without them they follow from
        ``fps``.
    """

    paths: Sequence[Path]
    rate: float | None = None
    read: ImageReader = read_color
    times: Sequence[float] | None = None

    @property
    def fps(self) -> float:
        return DEFAULT_FPS if self.rate is None else self.rate

    @property
    def timed(self) -> bool:
        return self.rate is not None or self.times is not None

    @property
    def length(self) -> int:
        return len(self.paths)

    @property
    def size(self) -> tuple[int, int]:
        return _size(self.read(self.paths[0]))

    def __iter__(self) -> Iterator[tuple[float, Image]]:
        return self.at(range(len(self.paths)))

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, Image]]:
        for index in indices:
            if index >= len(self.paths):
                raise ValueError(
                    f"{self.paths[0].parent}: expected {index + 1} images, got {len(self.paths)}"
                )
            yield index / self.fps if self.times is None else self.times[index], self.read(self.paths[index])


def timed_images(images: TimedPaths, read: ImageReader = read_color) -> Images:
    """Images with times, and the frame rate that follows from the median step between these."""
    times = [time for time, _ in images]
    step = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
    rate = 1 / step if step > 1 / MAX_FPS else None
    return Images([path for _, path in images], rate, read, times)


class Video:
    """A video file. Its length is None, for containers state their frame count wrongly or not at all.

    url: where it is instead, in a network.
    """

    length = None

    def __init__(self, path: Path, url: str = "") -> None:
        self.path, self.place = path, url or str(path)
        capture = self._open()
        rate = plausible_fps(capture.get(cv2.CAP_PROP_FPS))
        self.fps, self.timed = rate or DEFAULT_FPS, rate is not None
        capture.release()

    @property
    def size(self) -> tuple[int, int]:
        return _size(next(iter(self))[1])

    def __iter__(self) -> Iterator[tuple[float, Image]]:
        capture, index = self._open(), 0
        stated = capture.get(cv2.CAP_PROP_FRAME_COUNT)
        try:
            while (image := _read(capture)) is not None:
                yield index / self.fps, image
                index += 1
        finally:
            capture.release()
        if index == 0:
            raise ValueError(f"{self.place}: expected a video, this file has no frame that can be decoded")
        if index < MIN_DECODED_SHARE * stated:
            warnings.warn(
                f"{self.place}: only {index} of its {stated:.0f} frames can be decoded; is it cut off?",
                stacklevel=2,
            )

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, Image]]:
        """Reads all frames between, for seeking in videos isn't reliable."""
        capture, index = self._open(), 0
        try:
            for wanted in indices:
                while index < wanted and capture.grab():
                    index += 1
                image = _read(capture) if index == wanted else None
                if image is None:
                    raise ValueError(f"{self.place}: expected {wanted + 1} frames, got {index}")
                yield wanted / self.fps, image
                index += 1
        finally:
            capture.release()

    def count(self) -> int:
        """The number of frames, by reading all of them."""
        capture, count = self._open(), 0
        try:
            while capture.grab():
                count += 1
        finally:
            capture.release()
        return count

    def _open(self) -> cv2.VideoCapture:
        try:
            self.place.encode()
        except UnicodeEncodeError:
            raise ValueError(
                f"{self.place!a}: OpenCV opens only videos whose path is UTF-8; rename it"
            ) from None
        capture = cv2.VideoCapture(self.place)
        if not capture.isOpened():
            raise ValueError(f"{self.place}: expected a video, this file can't be opened as one")
        return capture


def read_image(path: Path, flag: int) -> Image:
    """The image in a file as cv2.imdecode gives it; ValueError or FileNotFoundError names the file."""
    if not path.exists():
        raise FileNotFoundError(f"{path}: there is no such file")
    content = np.fromfile(path, np.uint8)  # cv2.imread can't open every path
    try:
        image = cv2.imdecode(content, flag) if content.size and not _is_truncated(path) else None
    except cv2.error:  # an image larger than OpenCV allows
        image = None
    if image is None:
        raise ValueError(f"{path}: expected an image, this file can't be read as one")
    return image


def _is_truncated(path: Path) -> bool:
    """Whether a PNG file is truncated; libpng would write to stderr about it."""
    if path.suffix.lower() != ".png":
        return False
    with path.open("rb") as file:
        file.seek(max(0, file.seek(0, os.SEEK_END) - 4096))  # some tools write more after the end
        return b"IEND" not in file.read()


def plausible_fps(fps: float) -> float | None:
    """The frame rate that a file states; None where it is implausible: 0, NaN, thousands."""
    return fps if 0 < fps <= MAX_FPS else None


def _read(capture: cv2.VideoCapture) -> Image | None:
    there, image = capture.read()
    return image if there else None


def _size(image: Image) -> tuple[int, int]:
    return image.shape[1], image.shape[0]
