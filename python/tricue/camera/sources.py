# SPDX-License-Identifier: MIT
"""Whatever can be tracked in: a video, a folder of images, a sequence of a benchmark, a camera."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.streams import DEFAULT_FPS, Camera, Images, Stream, Video, image_paths, is_image
from tricue.camera.truth import find_truth

_COLOR_FOLDERS = ("img", "color", "left")  # OTB, VOT, stereo pairs
_VIDEOS = {".avi", ".m4v", ".mkv", ".mov", ".mp4", ".mpeg", ".mpg", ".ogv", ".webm", ".wmv"}


@dataclass(frozen=True)
class Source:
    """Frames in order, made of one stream a channel, with what is known about them.

    truth: (M, 4) true boxes x, y, width, height in pixels from 0, NaN where unknown; M may differ from the
        number of frames.
    """

    name: str
    color: Stream
    truth: NDArray[np.float64] | None = None

    @property
    def fps(self) -> float:
        return self.color.fps

    @property
    def length(self) -> int | None:
        """The number of frames, None where only reading them tells."""
        return self.color.length

    @property
    def first_box(self) -> Box | None:
        """The true box in the first frame, if it is known."""
        if self.truth is None or len(self.truth) == 0 or np.isnan(self.truth[0]).any():
            return None
        return Box(*self.truth[0].tolist())

    def __iter__(self) -> Iterator[Frame]:
        for seconds, image in self.color:
            yield Frame(image, timestamp=seconds)


def open_source(place: str | Path) -> Source:
    """Open a video file, a folder of images, a sequence folder, or a camera by its number.

    A sequence folder is OTB's (``img/``), VOT's (``sequence``), or one video, with a file of true boxes.
    Raises ValueError or OSError that names the place and what is wrong with it.
    """
    if isinstance(place, str) and place.isdecimal():
        return Source(f"camera {place}", Camera(int(place)))
    path = Path(place)
    if path.is_dir():
        return _folder(path)
    if not path.exists():
        raise FileNotFoundError(f"{place}: there is no such file or folder")
    if is_image(path):
        raise ValueError(f"{place}: expected a video or a folder, got one picture; give its folder")
    return Source(path.stem, Video(path))


def _folder(folder: Path) -> Source:
    name = folder.resolve().name
    if (folder / "sequence").is_file():
        return Source(name, _vot(folder), find_truth(folder))
    places = [folder / sub for sub in _COLOR_FOLDERS if (folder / sub).is_dir()]
    for place in (*places, folder):
        if paths := image_paths(place):
            return Source(name, Images(paths), find_truth(folder))
    videos = [path for path in sorted(folder.iterdir()) if path.suffix.lower() in _VIDEOS]
    if len(videos) == 1:
        return Source(name, Video(videos[0]), find_truth(folder))
    found = f"{len(videos)} videos; name one of them" if videos else "neither images nor a video"
    raise ValueError(f"{folder}: expected a folder of images or a sequence, found {found}")


def _vot(folder: Path) -> Images:
    """VOT's color channel: a pattern such as color/%08d.jpg, counted from 1."""
    lines = (folder / "sequence").read_text(encoding="utf-8", errors="replace").splitlines()
    values = {
        key.strip(): value.strip() for key, found, value in (line.partition("=") for line in lines) if found
    }
    pattern = values.get("channels.color") or values.get(f"channels.{values.get('channel.default')}", "")
    place = (folder / pattern).parent
    if "%" not in pattern or not place.is_dir():
        raise ValueError(f"{folder / 'sequence'}: expected channels.color=color/%08d.jpg, got {pattern!r}")
    paths = image_paths(place)
    if not paths:
        raise ValueError(f"{place}: expected the images of the color channel, found none")
    try:
        fps = float(values.get("fps", ""))
    except ValueError:
        fps = 0.0
    return Images(paths, fps if 0 < fps <= 1000 else DEFAULT_FPS)
