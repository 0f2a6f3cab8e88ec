# SPDX-License-Identifier: MIT
"""One channel's images in order: from a folder, a video file, or a live camera."""

import os
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

DEFAULT_FPS = 30.0
FASTEST = 1000.0  # frames a second


Image = NDArray[Any]
Read = Callable[[Path], Image]
Timed = list[tuple[float, Path]]  # seconds, and the image of that time


def read_color(path: Path) -> Image:
    """A picture as BGR, (H, W, 3) uint8; ValueError or FileNotFoundError that names the file."""
    return decode(path, cv2.IMREAD_COLOR)


class Stream(Protocol):
    """Images with their times in seconds; each iteration starts again (a camera goes on)."""

    @property
    def fps(self) -> float:
        """Frames a second; :data:`DEFAULT_FPS` where nothing tells them."""

    @property
    def timed(self) -> bool:
        """Whether the input tells when its images were taken, or how many there are in a second."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the first image, pixels."""

    @property
    def length(self) -> int | None:
        """The number of images, None where only reading them tells."""

    def __iter__(self) -> Iterator[tuple[float, Image]]: ...

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, Image]]:
        """The images of these rising numbers only; ValueError where there is none."""


@dataclass(frozen=True)
class Images:
    """Image files, in the given order; the error of ``read`` names the first that can't be read.

    rate: frames a second, None where nothing tells them. times: seconds, one an image; without them they
        follow from ``fps``.
    """

    paths: Sequence[Path]
    rate: float | None = None
    read: Read = read_color
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


def timed_images(images: Timed, read: Read = read_color) -> Images:
    """Images with times of their own, and the frame rate that follows from them."""
    times = [time for time, _ in images]
    step = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
    rate = 1 / step if step > 1 / FASTEST else None
    return Images([path for _, path in images], rate, read, times)


class Video:
    """A video file. Its frame count is not used: containers state it wrongly, or not at all."""

    length = None

    def __init__(self, path: Path) -> None:
        self.path = path
        capture = self._open()
        rate = sane_rate(capture.get(cv2.CAP_PROP_FPS))
        self.fps, self.timed = rate or DEFAULT_FPS, rate is not None
        capture.release()

    @property
    def size(self) -> tuple[int, int]:
        return _size(next(iter(self))[1])

    def __iter__(self) -> Iterator[tuple[float, Image]]:
        capture, index = self._open(), 0
        try:
            while (image := _read(capture)) is not None:
                yield index / self.fps, image
                index += 1
        finally:
            capture.release()
        if index == 0:
            raise ValueError(f"{self.path}: expected a video, this file has no frame that can be decoded")

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, Image]]:
        """Those between are read through, for videos can't be trusted to jump to the frame that was meant."""
        capture, index = self._open(), 0
        try:
            for wanted in indices:
                while index < wanted and capture.grab():
                    index += 1
                image = _read(capture) if index == wanted else None
                if image is None:
                    raise ValueError(f"{self.path}: expected {wanted + 1} frames, got {index}")
                yield wanted / self.fps, image
                index += 1
        finally:
            capture.release()

    def count(self) -> int:
        """The number of frames, by reading through."""
        capture, count = self._open(), 0
        try:
            while capture.grab():
                count += 1
        finally:
            capture.release()
        return count

    def _open(self) -> cv2.VideoCapture:
        capture = cv2.VideoCapture(str(self.path))
        if not capture.isOpened():
            raise ValueError(f"{self.path}: expected a video, this file can't be opened as one")
        return capture


class Camera:
    """A live camera by its number; OSError when it can't be opened or stops."""

    length = None
    timed = True  # by the clock

    def __init__(self, number: int) -> None:
        self.number = number
        self.capture = cv2.VideoCapture(number)
        if not self.capture.isOpened():
            raise OSError(f"camera {number}: can't be opened; is it plugged in and not in use elsewhere?")
        self.fps = sane_rate(self.capture.get(cv2.CAP_PROP_FPS)) or DEFAULT_FPS

    @property
    def size(self) -> tuple[int, int]:
        width, height = (self.capture.get(p) for p in (cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT))
        return int(width), int(height)

    def __iter__(self) -> Iterator[tuple[float, Image]]:
        start = time.monotonic()
        try:
            while (image := _read(self.capture)) is not None:
                yield time.monotonic() - start, image
        finally:
            self.capture.release()
        raise OSError(f"camera {self.number}: it stopped giving frames; was it unplugged?")

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, Image]]:
        raise ValueError(
            f"camera {self.number}: expected a recording, of which frames {indices[0]}, ... can be"
        )


def decode(path: Path, flag: int) -> Image:
    """The picture in a file as cv2.imread gives it; ValueError or FileNotFoundError that names the file."""
    if not path.exists():
        raise FileNotFoundError(f"{path}: there is no such file")
    try:
        image = None if _cut_off(path) else cv2.imread(str(path), flag)
    except cv2.error:  # a picture larger than OpenCV allows
        image = None
    if image is None:
        raise ValueError(f"{path}: expected an image, this file can't be read as one")
    return image


def _cut_off(path: Path) -> bool:
    """Whether a PNG file lacks its end, about which libpng would write to stderr by itself."""
    if path.suffix.lower() != ".png":
        return False
    with path.open("rb") as file:
        file.seek(max(0, file.seek(0, os.SEEK_END) - 4096))  # some tools write more behind the end
        return b"IEND" not in file.read()


def sane_rate(fps: float) -> float | None:
    """Frames a second that a file states; None for what can't be meant: 0, NaN, thousands."""
    return fps if 0 < fps <= FASTEST else None


def _read(capture: cv2.VideoCapture) -> Image | None:
    there, image = capture.read()
    return image if there else None


def _size(image: Image) -> tuple[int, int]:
    return image.shape[1], image.shape[0]
