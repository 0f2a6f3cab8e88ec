# SPDX-License-Identifier: MIT
"""Live streams: a thread reads a device, keeps only its newest images, and reopens it when it stops."""

import atexit
import time
import warnings
from collections.abc import Iterator, Sequence
from threading import Condition, Event, Thread
from typing import Any, NamedTuple, Protocol
from weakref import WeakSet

from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.data.joint import JointStream, Moment
from tricue.data.streams import DEFAULT_FPS

MAX_LAST_READ = 6.0  # seconds, in which a device's methods return

_lives: "WeakSet[Live]" = WeakSet()


class Device(Protocol):
    """A camera or a stream. Its methods are called in one thread, and return within MAX_LAST_READ.

    name: used in messages. remote: whether it may become available later, and is waited for.
    """

    name: str
    remote: bool

    def open(self) -> None:
        """Open the device; OSError or ImportError, in one line, if that fails."""

    def read(self) -> dict[str, NDArray[Any]] | None:
        """The next images by channel; None if there are no more."""

    def close(self) -> None:
        """Close the device; it can be opened again."""

    @property
    def fps(self) -> float | None:
        """Frames per second once it is open, None where unknown."""

    @property
    def camera(self) -> Intrinsics | None:
        """Its intrinsics once it is open, None where unknown."""


class Patience(NamedTuple):
    """Times in seconds: how long to wait for the first image; the first and the longest wait between tries,
    which doubles after each; and the time without images after which the stream has ended.
    """

    start: float = 10.0
    first_wait: float = 0.5
    longest_wait: float = 8.0
    silence: float = 60.0


class Health(NamedTuple):
    """The state of a stream: images dropped because newer ones came, number of reconnections, total seconds
    without images, and why there are none now, "" while they come.
    """

    dropped: int = 0
    reopened: int = 0
    silence: float = 0.0
    trouble: str = ""


class _Newest(NamedTuple):
    seconds: float
    images: dict[str, NDArray[Any]]


class Live:
    """A joint stream of a device's channels; each iteration gets the newest images.

    The device is opened at once, and its first images are waited for. OSError, in one line, if they don't
    come, if the device can't be opened, or, while reading, if it sends nothing for too long.
    """

    def __init__(self, device: Device, patience: Patience | None = None) -> None:
        self.device, self.patience = device, patience or Patience()
        self._news = Condition()
        self._thread: Thread | None = None
        self._running = Event()
        self._dropped = self._reopened = 0
        self._silence = 0.0
        self._stopped_by = ""
        self._begin = time.monotonic()
        self._start_thread()
        first = self._wait_for_first()
        self._sizes = {name: (image.shape[1], image.shape[0]) for name, image in first.images.items()}
        self.fps = device.fps or DEFAULT_FPS
        self.camera = device.camera

    @property
    def channels(self) -> tuple[str, ...]:
        """The names of the channels that the device gives."""
        return tuple(self._sizes)

    @property
    def health(self) -> Health:
        """The stream's state now; any thread may ask."""
        with self._news:
            return Health(self._dropped, self._reopened, self._silence, self._stopped_by)

    @property
    def paths(self) -> tuple[()]:
        return ()

    @property
    def remarks(self) -> tuple[str, ...]:
        found = []
        if self._dropped:
            found.append(
                f"{self.device.name}: dropped {self._dropped} frames that came while others were used"
            )
        if self._reopened:
            times = "once" if self._reopened == 1 else f"{self._reopened} times"
            found.append(
                f"{self.device.name}: connected again {times}, after {self._silence:.1f} s without images"
            )
        return tuple(found)

    def size(self, channel: str) -> tuple[int, int]:
        return self._sizes[channel]

    def moments(self, channels: Sequence[str], indices: Sequence[int] | None = None) -> Iterator[Moment]:
        if indices is not None:
            raise ValueError(f"{self.device.name}: expected a recording; a live camera can't go to a frame")
        return self._newest_moments(channels)

    def count(self) -> int:
        raise ValueError(f"{self.device.name}: expected a recording, of which the frames can be counted")

    def close(self) -> None:
        """Stop reading; iterating again starts anew."""
        with self._news:
            self._running.clear()
            self._news.notify_all()

    def _newest_moments(self, channels: Sequence[str]) -> Iterator[Moment]:
        self._start_thread()
        with self._news:
            self._dropped = 0  # images that came before this are no loss
        try:
            while (newest := self._wait_for_news()) is not None:
                yield {name: (newest.seconds, newest.images[name]) for name in channels}
        finally:
            self.close()

    # The condition guards what the thread and its reader share: _newest, _trouble, _failure, and the counts.
    # _running is an event, which both check at any time; when it is cleared, the condition is notified.

    def _start_thread(self) -> None:
        if self._running.is_set():
            return
        if self._thread is not None:
            self._thread.join()  # until then the device belongs to the thread
        _lives.add(self)
        with self._news:
            self._newest: _Newest | None = None
            self._trouble = ""
            self._failure: Exception | None = None
        self._running.set()
        self._thread = Thread(target=self._run, name=self.device.name, daemon=True)
        self._thread.start()

    def _wait_for_first(self) -> _Newest:
        with self._news:
            self._news.wait_for(lambda: self._newest or self._failure, self.patience.start)
            newest, failure, trouble = self._newest, self._failure, self._trouble
        if newest is not None:
            return newest
        self.close()
        if failure is not None:
            raise failure
        reason = f" ({trouble})" if trouble else ""
        raise OSError(
            f"{self.device.name}: no image within {self.patience.start:g} s{reason}; "
            "is it on, and is the address right?"
        )

    def _wait_for_news(self) -> _Newest | None:
        """The newest images, once; None if it was closed. Warns (UserWarning) of an interruption."""
        since = time.monotonic()
        while True:
            with self._news:
                self._news.wait_for(
                    lambda: self._newest or self._failure or self._trouble or not self._running.is_set(), 0.5
                )
                newest, self._newest = self._newest, None
                trouble, self._trouble = self._trouble, ""
                failure = self._failure
            if trouble:
                warnings.warn(f"{self.device.name}: {trouble}; connecting again", stacklevel=2)
            if newest is not None:
                return newest
            if failure is not None:
                raise failure
            if not self._running.is_set():
                return None
            silence = time.monotonic() - since
            if silence > self.patience.silence:
                raise OSError(f"{self.device.name}: no image for {silence:.0f} s; the stream has ended")

    def _run(self) -> None:
        """The thread's body. An error that ends it, even in closing the device, must reach the reader."""
        try:
            self._read()
        except Exception as error:
            self._fail(error)

    def _read(self) -> None:
        """Open, read, and reopen with growing waits, until it isn't running or an error ends it."""
        wait, stopped = self.patience.first_wait, 0.0
        any_read = False
        while self._running.is_set():
            try:
                trouble = "it stopped giving frames"
                self.device.open()
                while self._running.is_set() and (images := self.device.read()) is not None:
                    self._put(images, stopped, first=not any_read)
                    any_read, stopped, wait = True, 0.0, self.patience.first_wait
            except Exception as error:
                trouble = str(error)
                if not isinstance(error, OSError) or not (any_read or self.device.remote):
                    self._fail(error)
                    return
            finally:
                self.device.close()
            told, stopped = stopped > 0, stopped or time.monotonic()
            wait = self._pause("" if told else trouble, wait)

    def _put(self, images: dict[str, NDArray[Any]], stopped: float, first: bool) -> None:
        now = time.monotonic()
        with self._news:
            if first:
                self._trouble = ""  # trouble at the start is over
            elif stopped:
                self._reopened += 1
                self._silence += now - stopped
            self._stopped_by = ""
            self._dropped += self._newest is not None
            self._newest = _Newest(now - self._begin, images)
            self._news.notify_all()

    def _fail(self, error: Exception) -> None:
        """Report an error to the reader, unless another one was reported before."""
        with self._news:
            if self._failure is None:
                self._failure = error
            self._news.notify_all()

    def _pause(self, trouble: str, wait: float) -> float:
        """Wait before another try; return the next wait. trouble: "" if it was reported already."""
        with self._news:
            if self._running.is_set():
                self._trouble = trouble or self._trouble
                self._stopped_by = trouble or self._stopped_by
                self._news.notify_all()
                self._news.wait_for(lambda: not self._running.is_set(), wait)
        return min(2 * wait, self.patience.longest_wait)


@atexit.register
def _end_threads() -> None:
    """Wait for the threads: if one returned from a library while Python exits, it would abort the process."""
    for live in [*_lives]:
        live.close()
    for live in [*_lives]:
        if live._thread is not None:
            live._thread.join(MAX_LAST_READ)


class LiveStream(JointStream):
    """A channel of a live device."""

    joint: Live


def live_channels(live: Live) -> dict[str, LiveStream]:
    """The device's channels as streams."""
    return {name: LiveStream(live, name) for name in live.channels}
