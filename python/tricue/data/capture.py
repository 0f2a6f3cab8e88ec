# SPDX-License-Identifier: MIT
"""Devices that OpenCV opens: cameras by number or file, and streams by URL."""

import re
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.data.files import is_video
from tricue.data.streams import plausible_fps

_URL = re.compile(r"(rtsps?|rtmp|https?|udp|tcp|srt)://", re.IGNORECASE)
_TIMEOUT = 5000  # milliseconds, for opening a URL, and for each image


class Capture:
    """A device opened by cv2.VideoCapture: a camera's number, its file such as /dev/video0, or a URL."""

    camera: Intrinsics | None = None

    def __init__(self, place: str) -> None:
        self.place = place
        self.remote = is_url(place)
        self.name = without_password(place) if self.remote else f"camera {place}"
        self.fps: float | None = None
        self._capture: cv2.VideoCapture | None = None

    def open(self) -> None:
        self._capture = self._connect()
        if not self._capture.isOpened():
            if self.remote:
                raise OSError("it can't be opened")
            raise OSError(f"{self.name}: can't be opened; is it plugged in and not in use elsewhere?")
        self.fps = plausible_fps(self._capture.get(cv2.CAP_PROP_FPS))

    def read(self) -> dict[str, NDArray[Any]] | None:
        assert self._capture is not None
        there, image = self._capture.read()
        return {"color": np.asarray(image)} if there else None

    def close(self) -> None:
        if self._capture is not None:
            self._capture.release()
        self._capture = None

    def _connect(self) -> cv2.VideoCapture:
        if self.place.isdecimal():
            return cv2.VideoCapture(int(self.place))
        if not self.remote:
            return cv2.VideoCapture(self.place)
        limits = [cv2.CAP_PROP_OPEN_TIMEOUT_MSEC, _TIMEOUT, cv2.CAP_PROP_READ_TIMEOUT_MSEC, _TIMEOUT]
        return cv2.VideoCapture(self.place, cv2.CAP_FFMPEG, limits)


def is_url(place: str) -> bool:
    """Whether a place is the URL of a stream or of a file."""
    return _URL.match(place) is not None


def is_capture(place: str) -> bool:
    """Whether a place is a live camera.

    That is a number that isn't a folder's name, a file such as /dev/video0, or a URL that isn't a file's.
    """
    if place.isdecimal():
        return not Path(place).is_dir()
    if place.startswith("/dev/video"):
        return True
    return is_url(place) and not is_file_url(place)


def is_file_url(place: str) -> bool:
    """Whether a URL names a video file, which is read from start to end."""
    return is_url(place) and is_video(Path(urlsplit(place).path))


def without_password(url: str) -> str:
    """The URL without user and password, which end at the last @ before the path."""
    return re.sub(r"^(\w+://)[^/?#]*@", r"\1", url)
