# SPDX-License-Identifier: MIT
"""Live streams: a thread reads a device, keeps only its newest images, and reopens it when it stops."""

import atexit
import time
import warnings
from collections.abc import Iterable, Iterator, Sequence
from threading import Condition, Event, Thread
from typing import Any, NamedTuple, Protocol
from weakref import WeakSet

from numpy.typing import NDArray

from tricue.camera.rig import Intrinsics
from tricue.data.joint import JointStream, Moment, joints_of
from tricue.data.streams import DEFAULT_FPS, Stream

MAX_LAST_READ = 6.0  # seconds, within which a device's methods return

_lives: "WeakSet[Live]" = WeakSet()


class Device(Protocol):
    """A camera or a stream. Its methods are called in one thread, and return within MAX_LAST_READ.

    name: used in messages. remote: whether to wait for the device if it can't be opened at first.
    """

    name: str
    remote: bool

    def open(self) -> None:
        """Open the device; OSError or ImportError, with a message of one line, if that fails."""

    def read(self) -> dict[str, NDArray[Any]] | None:
        """The next images by channel; None if there are no more."""

    def close(self) -> None:
        """Close the device; it can be opened again."""

    @property
    def fps(self) -> float | None:
        """Frames per second once the device is open; None if unknown."""

    @property
    def camera(self) -> Intrinsics | None:
        """The intrinsics once the device is open; None if unknown."""


class Patience(NamedTuple):
    """How long to wait for a stream, seconds.

    start: for the first image. first_wait, longest_wait: between two attempts to open the device; the wait
    doubles after each. silence: without images, until the stream counts as ended.
    """

    start: float = 10.0
    first_wait: float = 0.5
    longest_wait: float = 8.0
    silence: float = 60.0


class Health(NamedTuple):
    """The state of a stream.

    dropped: number of images replaced by newer ones before they were used. reopened: number of reconnections.
    silence: total seconds of interruptions. trouble: why there are no images now; "" while they come.
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

    The constructor opens the device and waits for its first images. OSError, with a message of one line, if
    the device can't be opened; TimeoutError, which is one, if no images come, or, while reading, if none come
    for too long. Iterating again starts again.
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
        """The names of the device's channels."""
        return tuple(self._sizes)

    @property
    def health(self) -> Health:
        """The stream's current state; thread-safe."""
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
        """Stop reading; iterating again restarts it."""
        with self._news:
            self._running.clear()
            self._news.notify_all()

    def _newest_moments(self, channels: Sequence[str]) -> Iterator[Moment]:
        self._start_thread()
        with self._news:
            self._dropped = 0  # images from before the iteration don't count as dropped
        limit = max(self.patience.start, self.patience.silence)  # the device may have to be opened again
        try:
            while (newest := self._wait_for_news(limit)) is not None:
                limit = self.patience.silence
                yield {name: (newest.seconds, newest.images[name]) for name in channels}
        finally:
            self.close()

    # The condition guards what the thread and its reader share: _newest, _trouble, _failure, and the counts.
    # _running is an event, which both may check without the condition; who clears it notifies the condition.

    def _start_thread(self) -> None:
        if self._running.is_set():
            return
        if self._thread is not None:
            self._thread.join()  # until it ends, only that thread may use the device
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
        raise TimeoutError(
            f"{self.device.name}: no image within {self.patience.start:g} s{reason}; "
            "is it on, and is the address right?"
        )

    def _wait_for_news(self, limit: float) -> _Newest | None:
        """The newest images, each once; None after ``close``. Warns (UserWarning) of an interruption.

        limit: seconds, after which it raises TimeoutError.
        """
        since = time.monotonic()
        while True:
            with self._news:
                self._news.wait_for(
                    lambda: self._newest or self._failure or self._trouble or not self._running.is_set(),
                    min(0.5, limit),
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
            if time.monotonic() - since > limit:
                raise TimeoutError(f"{self.device.name}: no image for {limit:g} s; the stream has ended")

    def _run(self) -> None:
        """The thread's body. An error that ends it, even while closing the device, must reach the reader."""
        try:
            self._read()
        except Exception as error:
            self._fail(error)

    def _read(self) -> None:
        """Open, read, and reopen with growing waits, until ``close`` or a fatal error."""
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
                self._trouble = ""  # failed attempts before the first image aren't reported
            elif stopped:
                self._reopened += 1
                self._silence += now - stopped
            self._stopped_by = ""
            self._dropped += self._newest is not None
            self._newest = _Newest(now - self._begin, images)
            self._news.notify_all()

    def _fail(self, error: Exception) -> None:
        """Report an error to the reader, unless one was reported before."""
        with self._news:
            if self._failure is None:
                self._failure = error
            self._news.notify_all()

    def _pause(self, trouble: str, wait: float) -> float:
        """Wait before the next attempt; return the wait after that. trouble: "" if already reported."""
        with self._news:
            if self._running.is_set():
                self._trouble = trouble or self._trouble
                self._stopped_by = trouble or self._stopped_by
                self._news.notify_all()
                self._news.wait_for(lambda: not self._running.is_set(), wait)
        return min(2 * wait, self.patience.longest_wait)


def close_all(lives: Sequence[Live]) -> None:
    """Stop reading, and wait until the devices are closed, for MAX_LAST_READ at most."""
    for live in lives:
        live.close()
    for live in lives:
        if live._thread is not None:
            live._thread.join(MAX_LAST_READ)


def total_health(lives: Sequence[Live]) -> Health:
    """The sums over several devices, and the first one's trouble that has any."""
    found = [live.health for live in lives]
    return Health(
        sum(each.dropped for each in found),
        sum(each.reopened for each in found),
        sum(each.silence for each in found),
        next((each.trouble for each in found if each.trouble), ""),
    )


@atexit.register
def _end_threads() -> None:
    """Wait for the threads: one that returns from a library while Python exits would abort the process."""
    close_all([*_lives])


class LiveStream(JointStream):
    """A channel of a live device."""

    joint: Live


def lives_of(streams: Iterable[Stream]) -> list[Live]:
    """The live devices of the streams, each once."""
    return [joint for joint in joints_of(streams) if isinstance(joint, Live)]


def live_channels(live: Live) -> dict[str, LiveStream]:
    """The device's channels as streams."""
    return {name: LiveStream(live, name) for name in live.channels}
