# SPDX-License-Identifier: MIT
"""An error or Ctrl-C inside ``init`` or ``update`` leaves every tracker as it was."""

import copy
import pickle
from collections.abc import Callable
from itertools import cycle
from typing import Any, NamedTuple

import pytest
from tricue import Box, Frame, create
from tricue.kernels import load
from tricue.scenes import crossing, face_over_clutter, head, overtaking

ERRORS = (KeyboardInterrupt, MemoryError, ValueError)
STARTED = 4  # frames that the trackers have seen


class Case(NamedTuple):
    """A tracker's name and keywords, and a scene for it."""

    tracker: str
    keywords: dict[str, Any]
    frames: tuple[Frame, ...]
    box: Box


class Failing:
    """Kernels of which the n-th call, from 0, raises an error; without n they only count."""

    def __init__(self, n: int | None = None, error: type[BaseException] = ValueError) -> None:
        self.n, self.error, self.calls = n, error, 0

    def __getattr__(self, name: str) -> Callable[..., Any]:
        kernel = getattr(load("native"), name)

        def call(*arguments: Any, **keywords: Any) -> Any:
            self.calls += 1
            if self.calls - 1 == self.n:
                raise self.error
            return kernel(*arguments, **keywords)

        return call


def color() -> Case:
    """A face over clutter."""
    scene = face_over_clutter(seed=3, frames=8)
    return Case("color-particle", {"seed": 1}, scene.frames, scene.boxes[0])


def depth() -> Case:
    """A person who walks."""
    scene = crossing(seed=2, frames=8)
    return Case("depth-particle", {"intrinsics": scene.intrinsics, "seed": 1}, scene.frames, scene.boxes[0])


def stereo() -> Case:
    """A head before a stereo pair."""
    scene = head(1, 8, kind="hidden")
    return Case("stereo-head", {"rig": scene.rig}, scene.frames, scene.boxes[0])


def walk() -> Case:
    """A walker among others before a stereo pair."""
    scene = overtaking(0, 8)
    return Case("flow-depth", {"rig": scene.rig}, scene.frames, scene.boxes[0])


def fused() -> Case:
    """The same walker, for the fused tracker."""
    scene = overtaking(0, 8)
    return Case("fused", {"rig": scene.rig}, scene.frames, scene.boxes[0])


@pytest.fixture(scope="module", params=[color, depth, stereo, walk, fused], ids=lambda make: make.__name__)
def case(request: pytest.FixtureRequest) -> Case:
    """A tracker and its scene."""
    made: Case = request.param()
    return made


@pytest.fixture(scope="module")
def started(case: Case) -> bytes:
    """A tracker that has followed some frames, pickled."""
    tracker = create(case.tracker, **case.keywords)
    tracker.init(case.frames[0], case.box)
    for frame in case.frames[1:STARTED]:
        tracker.update(frame)
    return pickle.dumps(tracker)


def on(case: Case, tracker: Any) -> list[Any]:
    """The tracks of the frames that come next, and what can be drawn after each."""
    found = []
    for frame in case.frames[STARTED:]:
        track = tracker.update(frame)
        found.append((track, pickle.dumps([getattr(tracker, name) for name in sorted(tracker.traits.shows)])))
    return found


def calls(tracker: Any, act: Callable[[Any], Any]) -> int:
    """How many kernels are called in it."""
    tracker._k = counting = Failing()
    act(tracker)
    assert counting.calls > 0
    return counting.calls


@pytest.mark.parametrize("method", ["update", "init"])
def test_an_error_at_any_kernel_leaves_the_tracker(case: Case, started: bytes, method: str) -> None:
    """Whichever kernel raises, the next frames are tracked as if that call had never been."""

    def act(tracker: Any) -> None:
        if method == "update":
            tracker.update(case.frames[STARTED])
        else:
            tracker.init(case.frames[STARTED + 1], case.box)

    expected = on(case, pickle.loads(started))
    count = calls(pickle.loads(started), act)
    for n, error in zip(range(count), cycle(ERRORS), strict=False):
        tracker = pickle.loads(started)
        tracker._k = Failing(n, error)
        with pytest.raises(error):
            act(tracker)
        tracker._k = load("native")
        assert on(case, tracker) == expected, f"call {n} of {count}"


@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy], ids=lambda function: function.__name__)
def test_copies_are_independent(case: Case, started: bytes, copied: Callable[[Any], Any]) -> None:
    """A copy goes on by itself: neither it nor its original notices what the other tracks."""
    expected = on(case, pickle.loads(started))
    tracker = pickle.loads(started)
    other = copied(tracker)
    assert on(case, other) == expected
    assert on(case, tracker) == expected


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_every_pickle_protocol_keeps_the_state(case: Case, started: bytes, protocol: int) -> None:
    """A tracker pickled by any protocol goes on as if nothing had happened."""
    tracker = pickle.loads(pickle.dumps(pickle.loads(started), protocol))
    assert on(case, tracker) == on(case, pickle.loads(started))


def test_what_is_shown_can_not_be_written(case: Case, started: bytes) -> None:
    """Writing to what a tracker shows, as far as that is possible, doesn't change the track."""
    tracker = pickle.loads(started)
    for name in tracker.traits.shows & {"particles", "mask"}:
        shown = getattr(tracker, name)
        if shown.flags.writeable:
            shown[...] = 0
    assert on(case, tracker) == on(case, pickle.loads(started))
