# SPDX-License-Identifier: MIT
"""What a case of bad input is; run by bad_input.py."""

from collections.abc import Callable
from typing import Any, NamedTuple

import cv2
import tricue
from tricue.track.base.track import Tracker

cv2.setNumThreads(0)  # before any work: a process forked from one with a thread pool waits for it forever


class Case(NamedTuple):
    """Init on ``first`` and ``box``, then update on ``second``, whatever they are."""

    name: str
    first: Any
    box: Any
    second: Any
    starts: bool = True
    camera: Any = None
    truth: Any = None  # the true box in ``second``, if it isn't the default; None if there is no target


class Made(NamedTuple):
    """Something of ours that may fail while it is made; baselines get its bare image, if it has one."""

    make: Callable[[], Any]
    bare: Any = None


def made(value: Any) -> Any:
    """What it is, or makes."""
    return value.make() if isinstance(value, Made) else value


def with_tracker(
    create: Callable[[Case], Tracker], framed: Callable[[Any], Any] = made
) -> Callable[[Case], tricue.Track]:
    """A tracker of ours on a case. framed: makes its frames of the case's."""

    def follow(each: Case) -> tricue.Track:
        tracker = create(each)
        if each.starts:
            tracker.init(framed(each.first), each.box)
        return tracker.update(framed(each.second))

    return follow
