# SPDX-License-Identifier: MIT
"""Items made ahead of their use, on a thread of their own: decoding while a tracker works."""

from collections.abc import Generator, Iterable, Iterator
from queue import SimpleQueue
from threading import Event, Semaphore, Thread, current_thread
from typing import Generic, TypeVar

from tricue.camera.numbers import positive_whole

T = TypeVar("T")
AHEAD = 8


def prefetched(iterable: Iterable[T], ahead: int = AHEAD) -> Generator[T, None, None]:
    """The items of ``iterable`` in their order; a background thread makes up to ``ahead`` of them in advance.

    An exception of the iterable is raised after the items that came before it. The thread starts with the
    first item that is asked for. It ends with the iterable, and as soon as the item at hand is made when the
    iterator is closed, or nothing refers to it any more; the iterable's own iterator is closed by then.
    ValueError or TypeError where ``ahead`` isn't a whole number above 0.
    """
    return _consume(_Producer(iterable, positive_whole(ahead, "ahead", "items")))


class _Failure:
    """How the iterable ended: with an exception, or None."""

    def __init__(self, error: BaseException | None) -> None:
        self.error = error


class _Producer(Generic[T]):
    """The thread's side. ``room`` counts how many more items may be made, so that none waits in its hands."""

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
        """Whether to end, after waiting for room."""
        self.room.acquire()
        return self.stopped.is_set()

    def stop(self) -> None:
        self.stopped.set()
        self.room.release()


def _consume(producer: _Producer[T]) -> Generator[T, None, None]:
    # A daemon, for a process that ends with an iterator left open must not wait for it.
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
        if thread is not current_thread():  # which may be the one that collects an iterator left open
            thread.join()
