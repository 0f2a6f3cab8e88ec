# SPDX-License-Identifier: MIT
"""Streams: the images of one channel in order, from a folder or a video file."""

import importlib
import importlib.util
import math
import os
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any, Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

DEFAULT_FPS = 30.0
MAX_FPS = 1000.0
MIN_DECODED_SHARE = 0.95  # of the frames or the duration that a container states
MAX_MISCOUNTED = 4  # frames by which a duration may be too long: Flash's includes the delay of B-frames
TIME_ROUNDING = 0.001  # seconds: the unit of times in Matroska and Flash
PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
PNG_END = 4096  # bytes that are searched for the last chunk, as some tools append others
MAX_DAMAGED = 100  # frames in a row that can't be decoded, before the video counts as ended
DOUBTED_FPS = 60.0  # if a container states no rate, FFmpeg may give a higher one, derived from its time unit
FIRST_FRAMES = 16  # whose times are used to check such a rate

AnyImage = NDArray[Any]
ImageReader = Callable[[Path], AnyImage]
TimedPaths = list[tuple[float, Path]]
"""Times in seconds, and the image files of these times."""


def read_color(path: Path) -> AnyImage:
    """Read an image as BGR, (H, W, 3) uint8; ValueError or FileNotFoundError names the file."""
    return read_image(path, cv2.IMREAD_COLOR)


class Stream(Protocol):
    """Images with their times in seconds. Each iteration starts at the first one, unless it is a camera's."""

    @property
    def fps(self) -> float:
        """Frames per second; 30 if the input doesn't say."""

    @property
    def timed(self) -> bool:
        """Whether the input has times or a frame rate."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the first image, pixels."""

    @property
    def length(self) -> int | None:
        """The number of images; None if it isn't known before reading them."""

    def __iter__(self) -> Iterator[tuple[float, AnyImage]]: ...

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, AnyImage]]:
        """Only the images with these increasing indices; ValueError for an index beyond the last image."""


@dataclass(frozen=True)
class Images:
    """Image files in the given order; the error of ``read`` names the first that can't be read.

    rate: frames per second; None if unknown. times: seconds, one per image; by default index / ``fps``.
    """

    paths: Sequence[Path]
    rate: float | None = None
    read: ImageReader = read_color
    times: Sequence[float] | None = None

    def __repr__(self) -> str:
        """In one line, however many images there are."""
        ends = f", {str(self.paths[0])!r} to {str(self.paths[-1])!r}" if self.paths else ""
        return f"Images({len(self.paths)} files{ends}, fps={self.fps:g})"

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

    def __iter__(self) -> Iterator[tuple[float, AnyImage]]:
        return self.at(range(len(self.paths)))

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, AnyImage]]:
        for index in indices:
            if index >= len(self.paths):
                raise ValueError(
                    f"{self.paths[0].parent}: expected {index + 1} images, got {len(self.paths)}"
                )
            yield index / self.fps if self.times is None else self.times[index], self.read(self.paths[index])


def steps_back(times: Iterable[float]) -> list[int]:
    """The numbers, from 0, of those times that are before the previous one."""
    return [number for number, (before, now) in enumerate(pairwise(times), 1) if now < before]


def remark_on_steps_back(numbers: Sequence[int]) -> str:
    """The remark for the user on frames whose times are before the previous frame's."""
    several = f"{len(numbers)} frames, the first of them " if len(numbers) > 1 else ""
    return (
        f"the time goes back in {several}frame {numbers[0]}, as if the clock had been set back; "
        "there, trackers use their parameter rate"
    )


def image_names(channels: Mapping[str, Stream]) -> Sequence[str]:
    """The names of the image files to which boxes refer: color, or else depth; none for a video."""
    stream = channels.get("color") or channels.get("depth")
    return [path.name for path in stream.paths] if isinstance(stream, Images) else ()


def timed_images(images: TimedPaths, read: ImageReader = read_color) -> Images:
    """Images with times, and the frame rate given by the median time between images."""
    times = [time for time, _ in images]
    step = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
    rate = 1 / step if step > 1 / MAX_FPS else None
    return Images([path for _, path in images], rate, read, times)


class FrameTimes:
    """The times at which a video's frames are shown, from the times in its container.

    They are seconds from the first frame, and strictly increase. At a constant rate they are number / fps,
    without the container's rounding; so are times that the container doesn't give. fps: frames per second.
    """

    def __init__(self, fps: float) -> None:
        self._fps = fps
        self._begin = 0.0  # the container's time of the first frame
        self._number, self.last = -1, -1.0  # of the previous frame, and its time
        self.longest = 0.0  # the longest time from one frame to the next
        self.constant = True

    def add(self, told: float) -> float:
        """The next frame's time. told: the time in the container, seconds."""
        self._number += 1
        if self._number == 0:
            self._begin, self.last = told, 0.0
            return 0.0
        seconds = self._choose(told - self._begin, self._number / self._fps)
        self.longest = max(self.longest, seconds - self.last)
        self.last = seconds
        return seconds

    def _choose(self, told: float, nominal: float) -> float:
        agrees = abs(told - nominal) <= TIME_ROUNDING and nominal > self.last
        # After a repeated time, the container's times may be a frame late; rounded, some are just after last.
        if agrees or (self.constant and not told > self.last + TIME_ROUNDING):
            return nominal
        self.constant = False
        return told if told > self.last else self.last + 1 / self._fps


class Video:
    """A video file. Its length is None, because containers often state a wrong number of frames or none.

    url: its URL, if it isn't a local file. shown: its name in messages, without a password. stated_length:
    the number of frames that the container states, None if it states none.
    """

    length = None

    def __init__(self, path: Path, url: str = "", shown: str = "") -> None:
        self.path, self.place, self._is_remote = path, shown or url or str(path), bool(url)
        self._name = url or os.path.join(os.curdir, path)  # noqa: PTH118 (FFmpeg takes a: for a protocol)
        capture = self._open()
        rate = plausible_fps(capture.get(cv2.CAP_PROP_FPS))
        if rate is None or rate > DOUBTED_FPS:
            rate = checked_fps(rate, [_told(capture) for _ in range(FIRST_FRAMES) if capture.read()[0]])
        self.fps, self.timed = rate or DEFAULT_FPS, rate is not None
        self._times: Sequence[float] = ()  # until they are read
        self.stated_length = max(0, round(self._stated(capture)[0])) or None
        capture.release()

    @property
    def size(self) -> tuple[int, int]:
        return _size(next(iter(self))[1])

    @property
    def times(self) -> Sequence[float]:
        """The times of all frames, in seconds from the first; this reads the whole video.

        A warning tells of a video that is cut off.
        """
        self.count()
        return self._times

    def _read_times(self, progress: Callable[[int], object]) -> Sequence[float]:
        capture, times = self._open(), FrameTimes(self.fps)
        stated = self._stated(capture)
        found = []
        try:
            for seconds, _ in self._grab(capture, times):
                found.append(seconds)
                progress(len(found))
        finally:
            capture.release()
        self._warn_of_cut(len(found), times, *stated)
        return found

    def __iter__(self) -> Iterator[tuple[float, AnyImage]]:
        """A damaged frame between others gets the previous image, so that later frames keep their numbers."""
        capture, count, times = self._open(), 0, FrameTimes(self.fps)
        stated = self._stated(capture)
        image: AnyImage | None = None
        damaged = []
        try:
            for seconds, is_whole in self._grab(capture, times):
                image = _retrieved(capture) if is_whole else image
                if image is None:
                    break
                if not is_whole:
                    damaged.append(count)
                yield seconds, image
                count += 1
        finally:
            capture.release()
        if count == 0:
            raise ValueError(f"{self.place}: expected a video, this file has no frame that can be decoded")
        if damaged:
            several = (
                f"{len(damaged)} damaged frames, the first of them " if len(damaged) > 1 else "the damaged "
            )
            text = f"{self.place}: took the frame before in place of {several}frame {damaged[0]}"
            warnings.warn(text, stacklevel=2)
        self._warn_of_cut(count, times, *stated)

    def at(self, indices: Sequence[int]) -> Iterator[tuple[float, AnyImage]]:
        """Reads all frames up to the last index, because seeking in videos isn't reliable."""
        capture, index, whole = self._open(), -1, 0
        frames = self._grab(capture, FrameTimes(self.fps))
        try:
            for wanted in indices:
                found = None
                while index < wanted and (found := next(frames, None)):
                    index += 1
                    whole = index if found[1] else whole
                if found is None:
                    raise ValueError(f"{self.place}: expected {wanted + 1} frames, got {index + 1}")
                seconds, is_whole = found
                image = _retrieved(capture) if is_whole else next(self.at([whole]))[1]
                if image is None:
                    raise ValueError(f"{self.place}: expected {wanted + 1} frames, got {index}")
                yield seconds, image
        finally:
            capture.release()

    def count(self, progress: Callable[[int], object] = lambda _: None) -> int:
        """The number of frames; this reads the whole video. progress: called with the number read so far."""
        if not self._times:
            self._times = self._read_times(progress)
        return len(self._times)

    def _stated(self, capture: cv2.VideoCapture) -> tuple[float, float]:
        """The number of frames and the frame rate that the container states."""
        rate = plausible_fps(capture.get(cv2.CAP_PROP_FPS)) or self.fps
        return capture.get(cv2.CAP_PROP_FRAME_COUNT), rate

    def _warn_of_cut(self, count: int, times: FrameTimes, stated: float, rate: float) -> None:
        """Warn if much less was decoded than the container states."""
        missing = _missing(count, times, stated, rate)
        if missing and not self._is_read_whole(count, stated / rate):
            warnings.warn(f"{self.place}: only {missing} can be decoded; is it cut off?", stacklevel=3)

    def _grab(self, capture: cv2.VideoCapture, times: FrameTimes) -> Iterator[tuple[float, bool]]:
        """The time of each frame, and whether it could be grabbed; False for a damaged one between others."""
        damaged, patience = 0, 0  # no damaged frames are skipped before the first frame, or of a URL
        while damaged <= patience:
            if not capture.grab():
                damaged += 1
                continue
            told = _told(capture)
            for _ in range(damaged):
                yield times.add(-math.inf), False
            yield times.add(told), True
            damaged, patience = 0, 0 if self._is_remote else MAX_DAMAGED

    def _is_read_whole(self, count: int, duration: float) -> bool:
        """Whether the file has no more than ``count`` frames, and its sound or last frame fills its duration.

        Only PyAV can tell; False without it, and for a URL.
        """
        if self._is_remote or importlib.util.find_spec("av") is None:
            return False
        av: Any = importlib.import_module("av")
        packets, end = 0, 0.0
        with suppress(av.FFmpegError), av.open(self._name) as file:
            for packet in file.demux():
                packets += packet.size > 0 and packet.stream.type == "video"
                if packet.pts is not None:
                    end = max(end, float((packet.pts + (packet.duration or 0)) * packet.time_base))
        return count >= MIN_DECODED_SHARE * packets and end >= MIN_DECODED_SHARE * duration

    def _open(self) -> cv2.VideoCapture:
        try:
            self.place.encode()
        except UnicodeEncodeError:
            raise ValueError(
                f"{self.place!a}: OpenCV opens only videos whose path is UTF-8; rename it"
            ) from None
        capture = cv2.VideoCapture(self._name)
        if not capture.isOpened():
            if self._is_remote:
                raise ValueError(f"{self.place}: expected a video, none can be opened; is the address right?")
            raise ValueError(f"{self.place}: expected a video, this file can't be opened as one")
        return capture


def _told(capture: cv2.VideoCapture) -> float:
    """The time, in seconds, of the frame that was read last, according to the container; 0 if unknown."""
    return capture.get(cv2.CAP_PROP_POS_MSEC) / 1000


def _missing(count: int, times: FrameTimes, stated: float, fps: float) -> str:
    """How much of a video was decoded, in words; "" if all of it was.

    stated: the number of frames that the container states; some derive it from the duration and ``fps``,
    which is wrong unless the rate is constant.
    """
    if count >= min(MIN_DECODED_SHARE * stated, stated - MAX_MISCOUNTED):
        return ""
    if times.constant:
        return f"{count} of its {stated:.0f} frames"
    decoded, duration = times.last + times.longest, stated / fps
    return f"{decoded:.2f} of its {duration:.2f} seconds" if decoded < MIN_DECODED_SHARE * duration else ""


def read_image(path: Path, flag: int) -> AnyImage:
    """The image in a file as cv2.imdecode gives it; ValueError or FileNotFoundError names the file."""
    if not path.exists():
        raise FileNotFoundError(f"{path}: there is no such file")
    content = np.fromfile(path, np.uint8)  # cv2.imread can't open every path
    try:
        image = cv2.imdecode(content, flag) if content.size and not _is_truncated(content) else None
    except cv2.error:  # an image larger than OpenCV allows
        image = None
    if image is None:
        raise ValueError(f"{path}: expected an image, this file can't be read as one")
    return image


def _is_truncated(content: NDArray[np.uint8]) -> bool:
    """Whether this is a truncated PNG file, about which libpng would write to stderr."""
    is_png = content[: len(PNG_SIGNATURE)].tobytes() == PNG_SIGNATURE
    return is_png and b"IEND" not in content[-PNG_END:].tobytes()


def plausible_fps(fps: float) -> float | None:
    """The frame rate that a file states; None if it is implausible, such as 0, NaN or thousands."""
    return fps if 0 < fps <= MAX_FPS else None


def mean_rate(stated: float, frames: int, seconds: float) -> float:
    """The mean rate of so many frames, from the first to the last; the stated rate if that agrees with it."""
    mean = (frames - 1) / seconds if frames > 1 and seconds > 0 else stated
    return stated if math.isclose(mean, stated, rel_tol=1e-6) else mean


def checked_fps(fps: float | None, times: Sequence[float]) -> float | None:
    """The stated rate; if there is none, or it is far too high, the rate given by the first frames' times."""
    step = float(np.median(np.diff(times))) if len(times) > 1 else 0.0
    doubted = fps is None or (fps > DOUBTED_FPS and step > 1.5 / fps)
    return plausible_fps(1 / step) if doubted and step > 0 else fps


def _retrieved(capture: cv2.VideoCapture) -> AnyImage | None:
    there, image = capture.retrieve()
    return image if there else None


def _size(image: AnyImage) -> tuple[int, int]:
    return image.shape[1], image.shape[0]
