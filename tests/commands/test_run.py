# SPDX-License-Identifier: MIT
import os
import signal
import time
from collections.abc import Iterator

import numpy as np
import pytest
from tricue import Box, Frame, Status
from tricue.commands.run import Clock, steps, stoppable
from tricue.track.track import Tracker

BOX = Box(1, 2, 8, 9)


def frames(count: int, pause: float = 0.0) -> Iterator[Frame]:
    """Bright frames, each after a pause in seconds."""
    for _ in range(count):
        time.sleep(pause)
        yield Frame(np.full((20, 30, 3), 200, np.uint8))


def test_the_first_frame_starts_and_the_others_follow(drift: Tracker) -> None:
    """It proves that init is called once, with the box, update on every other frame, all in order."""
    clock = Clock()
    found = list(steps(drift, frames(4), lambda _: BOX, clock))
    assert [step.number for step in found] == [0, 1, 2, 3]
    assert [step.track.box.x for step in found] == [1.0, 3.5, 6.0, 8.5]
    assert (clock.decoded, clock.updates) == (4, 3)
    assert clock.statuses[Status.TRACKED] == 4


def test_it_waits_for_a_box(drift: Tracker) -> None:
    """It proves that frames before the first box are read but not tracked, and keep their numbers."""
    answers = iter([None, None, BOX])
    found = list(steps(drift, frames(5), lambda _: next(answers), Clock()))
    assert [step.number for step in found] == [2, 3, 4]


def test_decoding_is_told_apart(drift: Tracker) -> None:
    """It proves that a slow source counts as decoding, not as tracking."""
    clock = Clock()
    list(steps(drift, frames(5, pause=0.01), lambda _: BOX, clock))
    assert clock.decoding > 0.05
    assert clock.tracking < 0.02
    assert clock.speeds.startswith("tracking ")


def test_ctrl_c_asks_first_and_breaks_off_then() -> None:
    """It proves that the first SIGINT answers "stop?", a second interrupts, and the old handler returns."""
    before = signal.getsignal(signal.SIGINT)
    with stoppable() as stop:
        assert not stop()
        os.kill(os.getpid(), signal.SIGINT)
        assert stop()
        with pytest.raises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is before
