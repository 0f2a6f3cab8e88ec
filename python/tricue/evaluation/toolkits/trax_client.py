# SPDX-License-Identifier: MIT
"""TraX programs as trackers: any program that the VOT toolkit can run, started by a command.

The library is vot-trax (``pip install tricue[vot]``).
"""

import hashlib
import math
import shlex
import shutil
import subprocess
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.doctor.install import install_extra
from tricue.evaluation.toolkits.millimeters import to_millimeters
from tricue.evaluation.toolkits.trax_server import MISSING_EXTRA, bounding_box
from tricue.track.base.track import Status, Track

PATIENCE = 2.0  # seconds that a program gets to quit
CHANNELS = ("color", "depth")
MAX_HASHED = 1 << 28  # bytes; larger files aren't hashed for a program's version


class TraxError(RuntimeError):
    """A program's failure, described by the message."""


class TraxProgram:
    """A program behind the TraX protocol on standard input and output, with the interface of a tracker.

    It gets images as files, BMP for color and PNG in millimeters for depth, or in memory if it accepts only
    that. Its time is from request to answer, including its reading of files. It is restarted at each
    ``init``. ValueError for a command that can't be run, TraxError with the program's reason.
    """

    def __init__(self, command: str) -> None:
        self._words = command_words(command)
        self._folder = tempfile.TemporaryDirectory(prefix="tricue-trax-")
        self._box = Box(0, 0, 0, 0)
        self._connection: _Connection | None = None
        self.update_seconds = 0.0
        """The time of the last update."""

    def init(self, frame: Frame, box: Box) -> Track:
        """Start the program, and its tracker on the box."""
        self._disconnect()
        self._connection = _Connection(self._words)
        return self._track(self._connection.initialize(self._images(frame), box), box)

    def update(self, frame: Frame) -> Track:
        """Follow the target into the next frame."""
        assert self._connection is not None
        images = self._images(frame)
        start = time.perf_counter()
        state = self._connection.frame(images)
        self.update_seconds = time.perf_counter() - start
        return self._track(state, self._box)

    def close(self) -> None:
        """End the program."""
        self._disconnect()
        self._folder.cleanup()

    def _disconnect(self) -> None:
        if self._connection is not None:
            self._connection.close()
        self._connection = None

    def _images(self, frame: Frame) -> dict[str, Any]:
        import trax

        assert self._connection is not None
        images = {}
        for channel in self._connection.channels:
            frame.require(channel)
            image = getattr(frame, channel)
            if channel == "depth":
                image = to_millimeters(image)
            if "path" not in self._connection.formats:
                images[channel] = trax.MemoryImage.create(np.ascontiguousarray(image))
                continue
            path = Path(self._folder.name) / f"{channel}.{'png' if channel == 'depth' else 'bmp'}"
            if not cv2.imwrite(str(path), image):
                raise OSError(f"{path}: can't be written")
            images[channel] = trax.FileImage.create(str(path))
        return images

    def _track(self, state: Any, last: Box) -> Track:
        """The track of an answer; an empty or missing region means that the target is lost.

        Its score is the confidence; if that isn't a finite number, 1 with a box and 0 without.
        """
        region, properties = state
        box = bounding_box(region)
        found = all(map(math.isfinite, box)) and box.width > 0 and box.height > 0
        self._box = box if found else last
        score = _number(properties.get("confidence"))
        if not math.isfinite(score):
            score = float(found)
        return Track(self._box, score, Status.TRACKED if found else Status.LOST)


class _Connection:
    """A running program and the protocol's client. channels, formats: what the program requests."""

    def __init__(self, words: list[str]) -> None:
        try:
            import trax
            from trax.client import Client
        except ImportError:
            raise ImportError(MISSING_EXTRA.format(install_extra("vot"))) from None
        self._error = trax.TraxException
        try:
            self._process = subprocess.Popen(
                words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0, env=None
            )
        except OSError as error:
            raise ValueError(f"{words[0]}: {error.strerror}") from None
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        streams = self._process.stdin.fileno(), self._process.stdout.fileno()
        try:
            self._client = Client(stream=streams, log=lambda _: None)  # it crashes without a log
        except trax.TraxException as error:
            self._end()
            raise TraxError(f"{words[0]} doesn't speak TraX: {error}") from None
        self.channels = tuple(self._client.channels) or ("color",)
        self.formats = tuple(self._client.image_formats)

    def initialize(self, images: dict[str, Any], box: Box) -> Any:
        """Start on a box; return the region and properties of the reply."""
        import trax

        regions: list[Any] = [(trax.Rectangle.create(*box), {})]
        return self._state(lambda: self._client.initialize(images, regions, {}))

    def frame(self, images: dict[str, Any]) -> Any:
        """Send a frame; return the region and properties of the reply."""
        return self._state(lambda: self._client.frame(images, {}, []))

    def close(self) -> None:
        """Make the program quit."""
        with suppress(self._error, OSError):
            self._client.quit()
        self._end()

    def _state(self, request: Any) -> Any:
        try:
            states, _ = request()
        except self._error as error:
            raise TraxError(self._reason(error)) from None
        if len(states) != 1:
            raise TraxError(f"expected one region from the program, got {len(states)}")
        return states[0]

    def _reason(self, error: Exception) -> str:
        """The client's message, and how the program ended, if it did."""
        try:
            code = self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            return str(error)
        return f"{error} (the program ended with exit code {code})"

    def _end(self) -> None:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        with suppress(OSError):
            self._process.stdin.close()
        try:
            self._process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        with suppress(OSError):
            self._process.stdout.close()


def program_channels(command: str) -> frozenset[str]:
    """The channels that a program requests; this starts it. ValueError if it can't get them."""
    connection = _Connection(command_words(command))
    channels = connection.channels
    connection.close()
    if unknown := [name for name in channels if name not in CHANNELS]:
        raise ValueError(f"{command}: asks for the channel {unknown[0]}, which no sequence has")
    return frozenset(channels)


def program_version(command: str) -> dict[str, Any]:
    """What identifies a program's version: its command's words, and hashes of the files that they name."""
    words = command_words(command)
    files = [Path(found) for word in words if (found := shutil.which(word) or word) and Path(found).is_file()]
    hashed = [hashlib.sha256(path.read_bytes()).hexdigest() for path in files if _is_small(path)]
    return {"command": words, "files": hashed}


def command_words(command: str) -> list[str]:
    """The words of a command as a shell reads them; ValueError if there are none or quotes don't match."""
    try:
        words = shlex.split(command)
    except ValueError as error:
        raise ValueError(f"{command}: {error}") from None
    if not words:
        raise ValueError("trax: expected a command after it, got none")
    return words


def _number(text: str | None) -> float:
    """A property's number, NaN if it isn't one."""
    try:
        return math.nan if text is None else float(text)
    except ValueError:
        return math.nan


def _is_small(path: Path) -> bool:
    return path.stat().st_size <= MAX_HASHED
