# SPDX-License-Identifier: MIT
"""Whatever can be tracked in: a video, a folder of images, a sequence of a benchmark, a camera."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import count, pairwise
from operator import index
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.box_table import read_table, video_table
from tricue.camera.frame import Frame
from tricue.camera.layouts import depth_images, read_layout, table_note
from tricue.camera.numbers import positive
from tricue.camera.streams import FASTEST, Camera, Stream, Video, image_paths, is_image
from tricue.camera.truth import Truth, check_target

CALIBRATION = "intrinsics.toml"  # looked for in a sequence's folder, and in the folder of all sequences
PRINCETON = "frames.mat"  # the same of the Princeton benchmark, in the sequence's folder

Rectify = Callable[[NDArray[Any], NDArray[Any]], tuple[NDArray[Any], NDArray[Any]]]


@dataclass(frozen=True)
class Source:
    """Frames in order, made of one stream a channel, with what is known about them.

    channels: "color", "right", "depth"; images that belong together are at the same place of each. Times and
        frame rate are those of the first channel that has its own.
    truth: (M, 4) true boxes x, y, width, height in pixels from 0, NaN where absent or unknown; M may differ
        from the number of frames.
    calibration: a file with the cameras' intrinsics that lies beside the images.
    notes: what was left out of a folder and why, a sentence each.
    rate: frames a second of images of which nothing tells the times.
    rectify: makes a raw pair of color and right a rectified one.
    absent: (M,) whether it is known that the target can't be seen; of the others without a box, and of frames
        behind M, nothing is known.
    positions: (K, 3) the target's true X, Y, Z in the camera's frame, metres, NaN where unknown.
    format: the name of the layout that was recognised, such as "VOT RGB-D".

    ValueError where the channels are known to differ in length, also while iterating, and for a ``rate``
    beside times of their own.
    """

    name: str
    channels: Mapping[str, Stream]
    truth: NDArray[np.float64] | None = None
    calibration: Path | None = None
    notes: tuple[str, ...] = ()
    rate: float | None = None
    rectify: Rectify | None = None
    absent: NDArray[np.bool_] | None = None
    positions: NDArray[np.float64] | None = None
    format: str = ""

    def __post_init__(self) -> None:
        if self.truth is not None and self.absent is None:
            object.__setattr__(self, "absent", np.zeros(len(self.truth), np.bool_))
        if self.rate is not None:
            self._check_rate(self.rate)
        known = {name: stream.length for name, stream in self.channels.items() if stream.length is not None}
        if len(set(known.values())) > 1:
            got = " and ".join(f"{length} {name}" for name, length in known.items())
            raise ValueError(f"{self.name}: expected as many {' as '.join(known)} images, got {got}")

    @property
    def fps(self) -> float:
        """Frames a second, by which a video is written."""
        return self.channels[self._clock].fps if self.rate is None else self.rate

    @property
    def length(self) -> int | None:
        """The number of frames, None where only reading them tells."""
        lengths = (stream.length for stream in self.channels.values())
        return next((length for length in lengths if length is not None), None)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height, pixels, that a calibration has to fit: the depth images', else the color's."""
        return self.channels.get("depth", self._first).size

    @property
    def first_box(self) -> Box | None:
        """The true box in the first frame, if it is known."""
        if self.truth is None or len(self.truth) == 0 or np.isnan(self.truth[0]).any():
            return None
        return Box(*self.truth[0].tolist())

    def __iter__(self) -> Iterator[Frame]:
        return self._frames({name: iter(stream) for name, stream in self.channels.items()}, count())

    def frames(self, indices: Iterable[int]) -> Iterator[Frame]:
        """The frames of these rising numbers from 0 only. Of image files only theirs are read.

        ValueError for other numbers, and where there is no such frame.
        """
        wanted = _rising(indices)
        return self._frames({name: stream.at(wanted) for name, stream in self.channels.items()}, wanted)

    def _frames(
        self, streams: Mapping[str, Iterator[tuple[float, NDArray[Any]]]], numbers: Iterable[int]
    ) -> Iterator[Frame]:
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
            seconds = moment[self._clock][0] if self.rate is None else number / self.rate
            images = {name: image for name, (_, image) in moment.items()}
            color, right = images.get("color"), images.get("right")
            if self.rectify and color is not None and right is not None:
                color, right = self.rectify(color, right)
            yield Frame(color, images.get("depth"), right, seconds)

    @property
    def _first(self) -> Stream:
        return next(iter(self.channels.values()))

    @property
    def _clock(self) -> str:
        """The channel whose times count."""
        return next(
            (name for name, stream in self.channels.items() if stream.timed), next(iter(self.channels))
        )

    def _check_rate(self, rate: float) -> None:
        if not positive(rate, "--fps", "frames a second") <= FASTEST:
            raise ValueError(f"--fps: expected at most {FASTEST:.0f} frames a second, got {rate}")
        clock = self.channels[self._clock]
        if clock.timed:
            raise ValueError(
                f"--fps {rate:g}: expected with images that tell no times, but {self.name} has its own, "
                f"{clock.fps:.4g} frames a second; leave it out"
            )


def open_source(
    place: str | Path,
    *,
    depth: str | Path | None = None,
    depth_scale: float | None = None,
    fps: float | None = None,
    right: str | Path | None = None,
    target: str | None = None,
) -> Source:
    """Open a video file, a folder of images, a sequence folder, or a camera by its number.

    A sequence folder is OTB's (``img/``), VOT's (``sequence``), TUM's (``depth.txt``), the Princeton
    benchmark's (``rgb/r-0-1.png``), or one video, with a file of true boxes. 16-bit images are depth. Stereo
    pairs are KITTI's (``image_02`` and ``image_03``), or in ``left`` and ``right``.

    depth: a folder of 16-bit images, or a sequence folder with depth, beside the color of ``place``; they are
        paired by order.
    depth_scale: metres per unit of depth; needed but for VOT's, TUM's and Princeton's, whose format says it.
    fps: frames a second of images of which nothing tells the times, 30 without it; ValueError beside times.
    right: the right camera's video, folder or number, where ``place`` is the left one's; paired by order.
    target: one of :func:`tricue.camera.layouts.targets` of a folder with several; of KITTI's, the frames are
        those in which it is labelled.
    Raises ValueError or OSError that names the place and what is wrong with it.
    """
    source = _opened(place, depth_scale, target)
    if right is not None:
        source = _with_right(source, place, right)
    if depth is not None:
        source = _with_depth(source, place, Path(depth), depth_scale)
    if depth_scale is not None and "depth" not in source.channels:
        raise ValueError(f"{place}: expected depth images where --depth-scale is given, found only color")
    return source if fps is None else replace(source, rate=fps)


def _opened(place: str | Path, scale: float | None, target: str | None = None) -> Source:
    if isinstance(place, str) and place.isdecimal():
        return Source(f"camera {place}", {"color": Camera(int(place))}, format="camera")
    path = _existing(Path(place))
    if path.is_dir():
        layout = read_layout(path, scale, target)
        name = path.resolve().name if target is None else f"{path.resolve().name} {target}"
        return _with_truth(
            Source(
                name,
                layout.channels,
                calibration=_calibration(path) or layout.calibration,
                notes=layout.notes,
                format=layout.format,
            ),
            layout.truth,
        )
    if is_image(path):
        raise ValueError(f"{place}: expected a video or a folder, got one picture; give its folder")
    if target is not None:
        check_target(target, (), path)
    video = Source(path.stem, {"color": Video(path)}, format="video")
    table = video_table(path)
    return (
        video if table is None else replace(_with_truth(video, read_table(table)), notes=(table_note(table),))
    )


def _with_truth(source: Source, truth: Truth | None) -> Source:
    if truth is None:
        return source
    return replace(source, truth=truth.boxes, absent=truth.absent, positions=truth.positions)


def _rising(indices: Iterable[int]) -> list[int]:
    """The numbers, checked."""
    numbers = list(map(index, indices))
    if any(low >= high for low, high in pairwise([-1, *numbers])):
        raise ValueError(f"indices: expected rising numbers of frames from 0, got {numbers!r:.60}")
    return numbers


def _with_right(source: Source, place: str | Path, right: str | Path) -> Source:
    """The source's color as the left image, with another place's color as the right one."""
    streams = [opened.channels.get("color") for opened in (source, _opened(right, None))]
    for stream, at in zip(streams, (place, f"--right {right}"), strict=True):
        if stream is None:
            raise ValueError(f"{at}: expected color images of a stereo pair, found only depth")
    left, other = streams
    assert left
    assert other
    if isinstance(left, Camera) != isinstance(other, Camera):
        raise ValueError(f"--right {right}: expected two cameras or two recordings, got one of each")
    note = "the two cameras are read one after the other; what moves fast isn't at one place in both"
    notes = (*source.notes, note) if isinstance(left, Camera) else source.notes
    rest = {name: stream for name, stream in source.channels.items() if name not in ("color", "right")}
    channels = {"color": left, "right": other, **rest}
    return replace(source, channels=channels, notes=notes, format="stereo pair")


def _with_depth(source: Source, place: str | Path, depth: Path, scale: float | None) -> Source:
    """The source's color with another place's depth."""
    color = source.channels.get("color")
    if color is None:
        raise ValueError(f"{place}: expected color images beside --depth {depth}, found only depth")
    if isinstance(color, Camera):
        raise ValueError(f"--depth {depth}: expected with a video or a folder, got {source.name}")
    channels = {**source.channels, "depth": _depth_stream(_existing(depth), scale)}
    return replace(source, channels=channels, calibration=source.calibration or _calibration(depth))


def _depth_stream(place: Path, scale: float | None) -> Stream:
    if not place.is_dir():
        raise ValueError(f"{place}: expected a folder of 16-bit images of depth, got a file")
    if paths := image_paths(place):
        return depth_images(paths, scale)
    stream = read_layout(place, scale).channels.get("depth")
    if stream is None:
        raise ValueError(f"{place}: expected a folder of 16-bit images of depth, found only color")
    return stream


def _calibration(folder: Path) -> Path | None:
    places = (folder / CALIBRATION, folder.resolve().parent / CALIBRATION, folder / PRINCETON)
    return next((path for path in places if path.is_file()), None)


def _existing(path: Path) -> Path:
    if not path.exists():
        raise FileNotFoundError(f"{path}: there is no such file or folder")
    return path
