# SPDX-License-Identifier: MIT
import time
from collections.abc import Iterator

import numpy as np
import pytest
from tricue import Box, Frame, FusedTracker, MultiTracker, Status, Track
from tricue.cli.steps import RunClock, steps, steps_of_targets
from tricue.errors import BoxError, TargetNotFoundError
from tricue.track.base.track import Tracker
from tricue.track.base.traits import Channels, Traits

BOX = Box(1, 2, 8, 9)


def frames(count: int, pause: float = 0.0) -> Iterator[Frame]:
    """Bright frames, each after a pause in seconds."""
    for _ in range(count):
        time.sleep(pause)
        yield Frame(np.full((20, 30, 3), 200, np.uint8))


def test_the_first_frame_starts_and_the_others_follow(drift: Tracker) -> None:
    """It proves that init is called once, with the box, update on every other frame, all in order."""
    clock = RunClock()
    found = list(steps(drift, frames(4), lambda _: BOX, clock))
    assert [step.number for step in found] == [0, 1, 2, 3]
    assert [step.track.box.x for step in found] == [1.0, 3.5, 6.0, 8.5]
    assert (clock.decoded, clock.updates) == (4, 3)
    assert clock.statuses[Status.TRACKED] == 4


def test_errors_name_the_frame(drift: Tracker) -> None:
    """A frame that the tracker refuses is told by its number, with one target and with several."""
    small, others = np.zeros((10, 10, 3), np.uint8), list(frames(2))
    wrong = r"^frame 9: .*expected the first frame's size"
    with pytest.raises(ValueError, match=wrong):
        list(steps(FusedTracker(), [*others, Frame(small)], lambda _: BOX, RunClock(), first=7))
    with MultiTracker() as targets, pytest.raises(ValueError, match=wrong):
        list(steps_of_targets(targets, [*others, Frame(small)], [(7, BOX)], RunClock(), first=7))


def test_it_waits_for_a_box(drift: Tracker) -> None:
    """It proves that frames before the first box are read but not tracked, and keep their numbers."""
    answers = iter([None, None, BOX])
    found = list(steps(drift, frames(5), lambda _: next(answers), RunClock()))
    assert [step.number for step in found] == [2, 3, 4]


class Shy:
    """A tracker with ``objects`` that starts by itself where the frame is bright, else with this error."""

    traits = Traits(
        channels=(Channels.of("color"),), detects="person", shows=frozenset({"particles", "objects"})
    )

    def __init__(self, error: ValueError) -> None:
        self.error = error
        self.objects = [BOX]
        self.particles = np.array([[5.0, 6.0]])

    def init(self, frame: Frame, box: Box | None = None) -> Track:
        if frame.color is None or frame.color.max() < 100:
            raise self.error
        return Track(box or BOX, 1.0, Status.TRACKED)

    update = init


def dark_then_bright() -> list[Frame]:
    """Two dark frames, then two bright ones."""
    return [Frame(np.full((20, 30, 3), level, np.uint8)) for level in (0, 0, 200, 200)]


def test_it_waits_until_the_tracker_finds_somebody() -> None:
    """It proves that a tracker that looks for its target is asked again on every frame until it starts, the
    reason is kept, and its particles and objects come with every step.
    """
    clock = RunClock()
    shy = Shy(TargetNotFoundError("box: found nobody"))
    found = list(steps(shy, dark_then_bright(), None, clock))  # type: ignore[arg-type]
    assert [step.number for step in found] == [2, 3]
    assert (clock.decoded, clock.updates, clock.not_found_reason) == (4, 1, "box: found nobody")
    assert all(step.objects == [BOX] and len(step.particles) == 1 for step in found)


@pytest.mark.parametrize(
    "error",
    ["frame: expected the channel depth, which this tracker needs", "frame.depth: expected 4 rows", "gamma"],
)
def test_other_errors_are_not_waited_out(error: str) -> None:
    """It proves that an error that the next frame can't fix comes at once."""
    with pytest.raises(ValueError, match=error):
        next(steps(Shy(ValueError(error)), dark_then_bright(), None, RunClock()))  # type: ignore[arg-type]


def test_a_given_box_is_not_waited_out() -> None:
    """It proves that an error about a box that was given comes at once."""
    with pytest.raises(ValueError, match="box: outside"):
        next(steps(Shy(BoxError("box: outside")), dark_then_bright(), lambda _: BOX, RunClock()))  # type: ignore[arg-type]


def test_a_tracker_that_needs_a_box_says_so_at_once(drift: Tracker) -> None:
    """It proves that a tracker that doesn't look for its target isn't asked again."""
    with pytest.raises(ValueError, match="box: expected the target's box"):
        next(steps(drift, frames(3), None, RunClock()))


def test_decoding_is_told_apart(drift: Tracker) -> None:
    """It proves that a slow source counts as decoding, not as tracking."""
    clock = RunClock()
    list(steps(drift, frames(5, pause=0.01), lambda _: BOX, clock))
    assert clock.decoding > 0.05
    assert clock.tracking < 0.02
    assert clock.speeds.startswith("tracking ")
