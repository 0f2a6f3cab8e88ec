# SPDX-License-Identifier: MIT
"""A source of frames: one stream per channel, and what is known about the frames."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations, count, pairwise, permutations
from operator import index
from pathlib import Path
from typing import Any, TypeGuard

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.numbers import positive
from tricue.camera.read_calibration import KITTI_COLOR_CAMERAS
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.data.image_numbers import find_mismatch, find_unpaired
from tricue.data.joint import Moment, common_joint, joints_of
from tricue.data.live import Health, close_all, lives_of, total_health
from tricue.data.streams import MAX_FPS, Images, Stream, Video, remark_on_steps_back, steps_back

Rectify = Callable[[NDArray[Any], NDArray[Any]], tuple[NDArray[Any], NDArray[Any]]]
Register = Callable[[NDArray[Any]], NDArray[Any]]


@dataclass(frozen=True)
class Source:
    """Frames in order, with one stream per channel, and what is known about the frames.

    channels: "color", "right", "depth"; images of one frame have the same index in each. Times and frame rate
        are those of the first channel that has its own.
    truth: (M, 4) true boxes x, y, width, height in pixels from 0, NaN where absent or unknown; M may differ
        from the number of frames.
    calibration: a calibration file that was found beside the images.
    kitti_cameras: the left and right camera's numbers in a KITTI calibration.
    camera: the camera or rig described by the recording or device itself; with depth, the color camera if
        depth is registered to color, else the depth camera.
    notes: what was left out of a folder and why, and similar remarks, one sentence each.
    rate: frames per second, for images without times.
    rectify: rectifies a raw stereo pair (color, right).
    register: maps depth to the color image's pixels.
    absent: (M,) whether the target is known to be out of sight. Nothing is known about the target in other
        frames without a box, and after the last row.
    positions: (K, 3) the target's true X, Y, Z in the camera's frame, meters, NaN where unknown.
    format: the name of the layout, such as "VOT RGB-D".

    ValueError if the channels differ in length, which may be found only while iterating, and for a ``rate``
    if images have times of their own.
    """

    name: str
    channels: Mapping[str, Stream]
    truth: NDArray[np.float64] | None = None
    calibration: Path | None = None
    notes: tuple[str, ...] = ()
    rate: float | None = None
    rectify: Rectify | None = None
    register: Register | None = None
    absent: NDArray[np.bool_] | None = None
    positions: NDArray[np.float64] | None = None
    format: str = ""
    camera: Intrinsics | StereoRig | None = None
    kitti_cameras: tuple[int, int] = KITTI_COLOR_CAMERAS

    def __post_init__(self) -> None:
        if self.truth is not None and self.absent is None:
            object.__setattr__(self, "absent", np.zeros(len(self.truth), np.bool_))
        if self.rate is not None:
            self._check_rate(self.rate)
        known = {name: stream.length for name, stream in self.channels.items() if stream.length is not None}
        if len(set(known.values())) > 1:
            got = " and ".join(f"{length} {name}" for name, length in known.items())
            raise ValueError(
                f"{self.name}: expected as many {' as '.join(known)} images, got {got}{self._unpaired()}"
            )

    def _unpaired(self) -> str:
        """Which image has no other of its number, for an error; "" if names don't tell."""
        for images, others in permutations(filter(_is_untimed, self.channels.values()), 2):
            if alone := find_unpaired(images.paths, others.paths):
                return f"; {others.paths[0].parent} has none for {alone}"
        return ""

    @property
    def fps(self) -> float:
        """Frames per second."""
        return self.clock.fps if self.rate is None else self.rate

    @property
    def knows_times(self) -> bool:
        """Whether the frames' times are known; otherwise the rate ``fps`` is assumed."""
        return self.rate is not None or self.clock.timed

    @property
    def clock(self) -> Stream:
        """The stream whose times are the frames' times, unless there is a ``rate``."""
        return self.channels[self._clock]

    @property
    def length(self) -> int | None:
        """The number of frames; None if it isn't known before reading them."""
        lengths = (stream.length for stream in self.channels.values())
        return next((length for length in lengths if length is not None), None)

    @property
    def stated_length(self) -> int | None:
        """The number of frames for display: the length, or what a video's container states, maybe wrongly."""
        clock = self.clock
        return clock.stated_length if self.length is None and isinstance(clock, Video) else self.length

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels that a calibration must match.

        These are depth's, or color's if there is no depth, or if depth will be registered to color.
        """
        registered = self.register is not None and "color" in self.channels
        return self.channels.get("color" if registered else "depth", self._first).size

    @property
    def remarks(self) -> tuple[str, ...]:
        """Problems found while reading, such as images left out or a truncated recording; a sentence each."""
        found = [remark for joint in joints_of(self.channels.values()) for remark in joint.remarks]
        clock = self.clock
        if isinstance(clock, Images) and (numbers := steps_back(clock.times or ())):
            found.append(remark_on_steps_back(numbers))
        for images, others in combinations(filter(_is_untimed, self.channels.values()), 2):
            if pair := find_mismatch(images.paths, others.paths):
                found.append(
                    f"images are paired by order, though names differ from {pair[0]} and {pair[1]} on; "
                    "remove those that have no other of their number"
                )
        return tuple(found)

    @property
    def health(self) -> Health | None:
        """The state of a live camera, or the sum of two; None for a recording. Thread-safe.

        It has the number of dropped images, that of reconnections, and why no images come now.
        """
        lives = lives_of(self.channels.values())
        return total_health(lives) if lives else None

    def close(self) -> None:
        """Release a live camera; a ``with`` statement does so at its end. A recording needs no closing.

        A loop in another thread ends after at most one more frame. Iterating again opens the camera again.
        """
        close_all(lives_of(self.channels.values()))

    def __enter__(self) -> "Source":  # noqa: PYI034 (typing.Self is newer than Python 3.10)
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def first_box(self) -> Box | None:
        """The true box in the first frame; None if it isn't known."""
        return self.true_box(0)

    def true_box(self, number: int) -> Box | None:
        """The true box in a frame by its number from 0; None if it isn't known, as before the first frame."""
        if self.truth is None or not 0 <= number < len(self.truth) or np.isnan(self.truth[number]).any():
            return None
        return Box(*self.truth[number].tolist())

    def __iter__(self) -> Iterator[Frame]:
        return self._frames(self._moments(), count())

    def frames(self, indices: Iterable[int]) -> Iterator[Frame]:
        """Only the frames with these increasing indices, from 0; other image files aren't read.

        ValueError for indices that don't increase, or an index beyond the last frame.
        """
        wanted = _increasing(indices)
        return self._frames(self._moments(wanted), wanted)

    def _moments(self, wanted: list[int] | None = None) -> Iterator[Moment]:
        """The images by channel, moment by moment."""
        if joint := common_joint(self.channels.values()):
            return joint.moments(list(self.channels), wanted)
        streams = {
            name: iter(stream) if wanted is None else stream.at(wanted)
            for name, stream in self.channels.items()
        }
        return self._together(streams, count() if wanted is None else wanted)

    def _together(
        self, streams: Mapping[str, Iterator[tuple[float, NDArray[Any]]]], numbers: Iterable[int]
    ) -> Iterator[Moment]:
        """Moments of streams that are paired by order; ValueError if one ends before the others."""
        for number in numbers:
            found = {name: next(stream, None) for name, stream in streams.items()}
            moment = {name: image for name, image in found.items() if image is not None}
            if not moment:
                return
            if len(moment) < len(streams):
                ended = next(name for name in streams if name not in moment)
                raise ValueError(
                    f"{self.name}: expected as many {' as '.join(streams)} images, "
                    f"got {number} {ended} and more {next(iter(moment))}"
                )
            yield moment

    def _frames(self, moments: Iterator[Moment], numbers: Iterable[int]) -> Iterator[Frame]:
        for number, moment in zip(numbers, moments, strict=False):
            seconds = moment[self._clock][0] if self.rate is None else number / self.rate
            images = {name: image for name, (_, image) in moment.items()}
            try:
                frame = self._frame(images, seconds)
            except ValueError as error:  # which of thousands of images it was
                raise ValueError(f"frame {number}: {error}") from error
            yield frame

    def _frame(self, images: Mapping[str, NDArray[Any]], seconds: float) -> Frame:
        """The frame of one moment, with its stereo pair rectified and its depth registered as needed."""
        color, depth, right = (images.get(name) for name in ("color", "depth", "right"))
        if self.rectify and color is not None and right is not None:
            color, right = self.rectify(color, right)
        if self.register and depth is not None:
            depth = self.register(depth)
        return Frame(color, depth, right, seconds)

    @property
    def _first(self) -> Stream:
        return next(iter(self.channels.values()))

    @property
    def _clock(self) -> str:
        """The channel name of :attr:`clock`."""
        return next(
            (name for name, stream in self.channels.items() if stream.timed), next(iter(self.channels))
        )

    def _check_rate(self, rate: float) -> None:
        if not positive(rate, "fps", "frames per second") <= MAX_FPS:
            raise ValueError(f"fps: expected at most {MAX_FPS:.0f} frames per second, got {rate}")
        clock = self.clock
        if clock.timed:
            raise ValueError(
                f"fps={rate:g}: expected with images without times, but {self.name} has its own, "
                f"{clock.fps:.4g} frames per second; leave it out"
            )


def _is_untimed(stream: Stream) -> TypeGuard[Images]:
    """Whether images are paired by order, not by their times."""
    return isinstance(stream, Images) and stream.times is None


def _increasing(indices: Iterable[int]) -> list[int]:
    """The indices as a list; ValueError unless they are increasing and not negative."""
    numbers = list(map(index, indices))
    if any(low >= high for low, high in pairwise([-1, *numbers])):
        raise ValueError(f"indices: expected rising numbers of frames from 0, got {numbers!r:.60}")
    return numbers
