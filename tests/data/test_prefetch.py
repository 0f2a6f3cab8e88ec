# SPDX-License-Identifier: MIT
import gc
import threading
import time
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tricue.data.open_source import open_source
from tricue.data.prefetch import MAX_PREFETCHED, prefetch


class Counting:
    """Whole numbers from 0, and how many were made; ``closed`` is set once their iterator is."""

    def __init__(self, end: int = 10**9, error: Exception | None = None) -> None:
        self.end, self.error = end, error
        self.made, self.closed = 0, False

    def __iter__(self) -> Iterator[int]:
        try:
            for number in range(self.end):
                self.made += 1
                yield number
            if self.error is not None:
                raise self.error
        finally:
            self.closed = True


def threads() -> list[threading.Thread]:
    """Those of prefetching that run."""
    return [thread for thread in threading.enumerate() if thread.name == "prefetched"]


def until(condition: Callable[[], bool]) -> bool:
    """Whether the condition comes to hold within ten seconds."""
    end = time.monotonic() + 10
    while not condition() and time.monotonic() < end:
        time.sleep(0.001)
    return condition()


@pytest.mark.parametrize("ahead", [1, 2, 100])
@pytest.mark.parametrize("end", [0, 1, 50])
def test_all_come_in_order(ahead: int, end: int) -> None:
    """It proves that nothing is lost, doubled or turned round, and that the thread ends with the last."""
    items = Counting(end)
    assert list(prefetch(items, ahead)) == list(range(end))
    assert items.closed
    assert not threads()


def test_an_error_comes_at_its_place() -> None:
    """It proves that what came before an error is given first, and then that very error."""
    error = OSError("unplugged")
    found = prefetch(Counting(5, error), 3)
    assert list(islice(found, 5)) == [0, 1, 2, 3, 4]
    with pytest.raises(OSError, match="unplugged") as raised:
        next(found)
    assert raised.value is error
    assert list(found) == []
    assert not threads()


def test_no_more_than_ahead_wait() -> None:
    """It proves that the thread makes ``ahead`` items and then waits, however slow the consumer is, so that
    memory doesn't grow with the length.
    """
    items = Counting()
    found = prefetch(items)
    for taken in range(1, 40):
        next(found)
        assert until(lambda: items.made == taken + MAX_PREFETCHED)  # noqa: B023 (called at once)
    time.sleep(0.05)
    assert items.made == 39 + MAX_PREFETCHED
    found.close()  # type: ignore[attr-defined]


def test_nothing_is_made_before_it_is_asked_for() -> None:
    """It proves that an iterator that nobody uses starts no thread."""
    items = Counting()
    found = prefetch(items)
    assert not threads()
    del found
    assert items.made == 0


def leave_open(items: Counting) -> None:
    """A loop that is broken off."""
    for number in prefetch(items):
        if number == 3:
            break


def close(items: Counting) -> None:
    """An iterator that is closed."""
    found: Any = prefetch(items)
    next(found)
    found.close()


def fail(items: Counting) -> None:
    """A consumer that raises."""

    def consume() -> None:
        for _ in prefetch(items):
            raise RuntimeError("mine")

    with pytest.raises(RuntimeError, match="mine"):
        consume()


def leave_in_a_circle(items: Counting) -> None:
    """An iterator that only the garbage collector finds."""
    found = prefetch(items)
    next(found)
    circle: list[Any] = [found]
    circle.append(circle)


@pytest.mark.parametrize("leave", [leave_open, close, fail, leave_in_a_circle])
def test_the_thread_ends_with_its_consumer(leave: Callable[[Counting], None]) -> None:
    """It proves that an iterator that is left closes the iterable and leaves no thread, in whatever way."""
    items = Counting()
    leave(items)
    gc.collect()
    assert not threads()
    assert items.closed
    assert items.made <= 5 + MAX_PREFETCHED


def test_collecting_on_the_thread_itself() -> None:
    """It proves that the thread ends too where the garbage collector runs on it, which can't wait for
    itself.
    """
    holder: list[Any] = []
    alone = threading.Event()
    ended_on: list[str] = []

    def items() -> Iterator[int]:
        yield 0
        assert alone.wait(10)
        holder.clear()  # the last reference
        ended_on.append(threading.current_thread().name)
        yield 1

    holder.append(prefetch(items()))
    assert next(holder[0]) == 0
    alone.set()
    assert until(lambda: not threads())
    assert ended_on == ["prefetched"]


@pytest.mark.parametrize(("ahead", "error"), [(0, ValueError), (-1, ValueError), (1.5, TypeError)])
def test_bad_ahead_is_refused(ahead: Any, error: type[Exception]) -> None:
    """It proves that a number of items that can't be is an error at once."""
    with pytest.raises(error, match=r"^ahead: expected"):
        prefetch([], ahead)


def test_frames_of_a_source(tmp_path: Path) -> None:
    """It proves that a source's frames come as they do without a thread, its error too."""
    for index in range(12):
        cv2.imwrite(str(tmp_path / f"{index}.png"), np.full((8, 8, 3), index, np.uint8))
    source = open_source(tmp_path)
    for plain, ahead in zip(source, prefetch(source, 3), strict=True):
        assert plain.timestamp == ahead.timestamp
        np.testing.assert_array_equal(plain.color, ahead.color)
    (tmp_path / "9.png").write_bytes(b"")
    found = prefetch(source)
    assert len(list(islice(found, 9))) == 9
    with pytest.raises(ValueError, match=r"9\.png: expected an image"):
        next(found)
