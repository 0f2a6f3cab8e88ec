# SPDX-License-Identifier: MIT
"""A case of bad input; run by bad_input.py."""

from collections.abc import Callable
from typing import Any, NamedTuple

import cv2
import tricue
from tricue.track.base.track import Tracker

cv2.setNumThreads(0)  # before any work: a forked process would wait forever for its parent's thread pool


class Case(NamedTuple):
    """One ``init`` with ``first`` and ``box``, then one ``update`` with ``second``."""

    name: str
    first: Any
    box: Any
    second: Any
    starts: bool = True
    camera: Any = None
    truth: Any = None  # the true box in ``second``, if it isn't the default; None if there is no target


class Made(NamedTuple):
    """A value of tricue's that may fail while it is made; baselines get its bare image, if it has one."""

    make: Callable[[], Any]
    bare: Any = None


def made(value: Any) -> Any:
    """The value itself, or what a Made makes."""
    return value.make() if isinstance(value, Made) else value


def with_tracker(
    create: Callable[[Case], Tracker], framed: Callable[[Any], Any] = made
) -> Callable[[Case], tricue.Track]:
    """A tricue tracker on a case. framed: makes the tracker's frames from the case's."""

    def follow(each: Case) -> tricue.Track:
        tracker = create(each)
        if each.starts:
            tracker.init(framed(each.first), each.box)
        return tracker.update(framed(each.second))

    return follow
