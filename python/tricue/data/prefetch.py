# SPDX-License-Identifier: MIT
"""Prefetching: a background thread makes items before they are needed, for example decodes while tracking."""

from collections.abc import Generator, Iterable, Iterator
from queue import SimpleQueue
from threading import Event, Semaphore, Thread, current_thread
from typing import Generic, TypeVar

from tricue.camera.numbers import positive_whole

T = TypeVar("T")
MAX_PREFETCHED = 8


def prefetch(iterable: Iterable[T], ahead: int = MAX_PREFETCHED) -> Generator[T, None, None]:
    """Iterate over ``iterable``; a background thread makes up to ``ahead`` items in advance.

    An exception of the iterable is raised after the items that came before it. The thread starts when the
    first item is requested. It ends with the iterable, or after the item in progress if this iterator is
    closed or garbage collected; then it closes the iterable's own iterator. ValueError or TypeError if
    ``ahead`` isn't a whole number above 0.
    """
    return _consume(_Producer(iterable, positive_whole(ahead, "ahead", "items")))


class _Failure:
    """How the iterable ended: with an exception, or normally (None)."""

    def __init__(self, error: BaseException | None) -> None:
        self.error = error


class _Producer(Generic[T]):
    """The background thread's side; ``room`` counts the items that may still be made."""

    def __init__(self, iterable: Iterable[T], ahead: int) -> None:
        self.iterable = iterable
        self.room, self.stopped = Semaphore(ahead), Event()
        self.made: SimpleQueue[T | _Failure] = SimpleQueue()

    def run(self) -> None:
        error = None
        try:
            self._make(iter(self.iterable))
        except BaseException as raised:  # the consumer raises it
            error = raised
        self.made.put(_Failure(error))

    def _make(self, iterator: Iterator[T]) -> None:
        try:
            while not self._stops():
                self.made.put(next(iterator))
        except StopIteration:
            return
        finally:
            close = getattr(iterator, "close", None)
            if close is not None:
                close()

    def _stops(self) -> bool:
        """Wait for room; return whether to stop."""
        self.room.acquire()
        return self.stopped.is_set()

    def stop(self) -> None:
        self.stopped.set()
        self.room.release()


def _consume(producer: _Producer[T]) -> Generator[T, None, None]:
    # A daemon thread, so that a process doesn't wait for an iterator that was left open.
    thread = Thread(target=producer.run, name="prefetched", daemon=True)
    thread.start()
    try:
        while not isinstance(item := producer.made.get(), _Failure):
            producer.room.release()
            yield item
        if item.error is not None:
            raise item.error
    finally:
        producer.stop()
        if thread is not current_thread():  # the thread itself may garbage-collect an iterator left open
            thread.join()
