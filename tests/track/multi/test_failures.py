# SPDX-License-Identifier: MIT
"""After errors, Ctrl-C and calls by handlers, all targets are as they were."""

import copy
import warnings
from typing import Any

import numpy as np
import pytest
from tricue import Box, Frame, MultiTracker, Status, Track
from tricue.errors import MissingChannelError
from tricue.kernels import load
from tricue.track.base.traits import Channels, Traits

from tests.track.multi.kinds import FUSED, KINDS, each_workers, on


@pytest.mark.parametrize("workers", [1, 2])
def test_an_error_names_its_target(workers, things):
    """After a change of the frame's size, it is the one whose first frame had another size."""
    small = Frame(np.ascontiguousarray(things.frames[0].color[::2, ::2]))
    with MultiTracker(workers=workers) as several:
        several.add(things.frames[0], things.boxes[0])
        several.add(small, (10, 10, 40, 40))
        with pytest.raises(ValueError, match=r"^target 2: frame.color: expected the first frame's size"):
            several.update(things.frames[1])
        with pytest.raises(ValueError, match=r"^target 1: frame.color: expected the first frame's size"):
            several.update(small)
        several.remove(2)
        assert list(several.update(things.frames[1])) == [1]


class Failing:
    """A third party's, whose every update raises an error."""

    error: Exception

    def init(self, image: Any, box: Any) -> None: ...

    def update(self, image: Any) -> None:
        raise self.error


def test_an_error_keeps_what_comes_with_its_message(things, monkeypatch):
    """The target is named in the message alone."""
    monkeypatch.setattr(Failing, "error", ValueError("no target", 7), raising=False)
    several = MultiTracker(f"{__name__}:Failing")
    several.add(things.frames[0], things.boxes[0])
    with pytest.raises(ValueError, match="target 1: no target") as told:
        several.update(things.frames[1])
    assert told.value.args == ("target 1: no target", 7)


@pytest.mark.parametrize("error", [ValueError(), KeyError(5), OSError(2, "no such file")], ids=repr)
def test_an_error_without_a_message_stays_as_it_is(error, things, monkeypatch):
    """One that begins with no text has none that could name its target."""
    monkeypatch.setattr(Failing, "error", error, raising=False)
    arguments = error.args
    several = MultiTracker(f"{__name__}:Failing")
    several.add(things.frames[0], things.boxes[0])
    with pytest.raises(type(error)) as told:
        several.update(things.frames[1])
    assert told.value is error
    assert error.args == arguments


class Slotted:
    """A third party's with traits and Params, so it isn't wrapped, and without a ``__dict__``."""

    __slots__ = ("box",)
    traits = Traits(channels=(Channels.of("color"),))
    Params = None

    def __init__(self, seed: int, kernels: str) -> None: ...

    def init(self, frame: Frame, box: Box) -> Track:
        self.box = Box(*box)
        return self.update(frame)

    def update(self, frame: Frame) -> Track:
        return Track(self.box, 1.0, Status.TRACKED)


@pytest.mark.parametrize("workers", [1, 2])
def test_a_tracker_may_have_slots(workers, things):
    """Nothing of it is saved before an update, as of no third party's is promised."""
    with MultiTracker(f"{__name__}:Slotted", workers=workers) as several:
        for box in things.boxes[:2]:
            several.add(things.frames[0], box)
        assert [track.box for track in several.update(things.frames[1]).values()] == [*things.boxes[:2]]


class Calling:
    """Kernels, of which each first calls a function, as a signal's handler may be called anywhere."""

    def __init__(self, call: Any) -> None:
        self.call, self.kernels = call, load("native")

    def __getattr__(self, name: str) -> Any:
        self.call()
        return getattr(self.kernels, name)


@pytest.mark.parametrize("workers", [1, 2])
@pytest.mark.parametrize("method", ["add", "remove", "update", "copy"])
def test_a_handler_may_not_call_in_the_middle(workers, method, things, alone, started):
    """It would wait for itself, or change the targets that are gone through; the call that it came in fails
    as a whole.
    """
    with started(FUSED, workers=workers) as several:
        calls = {
            "add": lambda: several.add(things.frames[0], things.boxes[0]),
            "remove": lambda: several.remove(several.ids[-1]),
            "update": lambda: several.update(things.frames[1]),
            "copy": lambda: copy.copy(several),
        }
        here = several._targets if workers == 1 else several._targets._here
        tracker = here._trackers[1]
        tracker._k = Calling(calls[method])
        with pytest.raises(RuntimeError, match="in the middle of another call"):
            several.update(things.frames[1])
        tracker._k = load("native")
        assert on(several, things.frames[1:]) == alone(FUSED)


@pytest.mark.parametrize("workers", [1, 2])
def test_a_handler_may_close_in_the_middle(workers, things, started):
    """As one of SIGTERM does before it ends the program."""
    several = started(FUSED, workers=workers)

    def end() -> None:
        several.close()
        raise SystemExit

    here = several._targets if workers == 1 else several._targets._here
    here._trackers[1]._k = Calling(end)
    with pytest.raises(SystemExit):
        several.update(things.frames[1])
    with pytest.raises(RuntimeError, match="is closed"):
        several.update(things.frames[1])


@each_workers
@pytest.mark.parametrize("place", [0, 1, 2])
def test_an_error_of_one_target_leaves_all(workers, place, things, alone):
    """Wherever the target is that a frame is wrong for, the others haven't seen that frame either."""
    depth = np.full(things.frames[0].color.shape[:2], 4.0, np.float32)
    depth[20:80, 100:130] = 2.0
    kinds = ["fused", "color-particle"]
    kinds.insert(place, "depth-particle")
    both = [Frame(frame.color, depth) for frame in things.frames]
    with MultiTracker(workers=workers) as several, MultiTracker() as expected:
        for kind, box in zip(kinds, things.boxes, strict=False):
            start = (100, 20, 30, 60) if kind == "depth-particle" else box
            several.add(both[0], start, kind)
            expected.add(both[0], start, kind)
        for frame in both[1:]:
            message = f"target {place + 1}: frame: expected the channel depth"
            with pytest.raises(MissingChannelError, match=message) as error:
                several.update(Frame(frame.color))
            assert error.value.channel == "depth"
            assert several.update(frame) == expected.update(frame)


class Interrupting:
    """Kernels of which each raises KeyboardInterrupt."""

    def __getattr__(self, name: str) -> Any:
        raise KeyboardInterrupt


def test_ctrl_c_leaves_all(things, alone, started):
    """It comes while this process's own target is followed; those of the worker go back with it."""
    with started(KINDS, workers=2) as several:
        assert on(several, things.frames[1:3]) == alone(KINDS)[:2]
        tracker = several._targets._here._trackers[1]
        tracker._k = Interrupting()
        with pytest.raises(KeyboardInterrupt):
            several.update(things.frames[5])
        tracker._k = load("native")
        assert on(several, things.frames[3:]) == alone(KINDS)[2:]


class InterruptingTracks(dict[int, Track]):
    """Tracks of which each raises KeyboardInterrupt."""

    def __getitem__(self, target: int) -> Track:
        raise KeyboardInterrupt


@each_workers
def test_ctrl_c_after_the_last_target_leaves_all(workers, things, alone, started, monkeypatch):
    """It comes when all were followed, and their tracks aren't kept yet."""
    with started(FUSED, workers=workers) as several:
        update = several._targets.update
        with monkeypatch.context() as patched:
            patched.setattr(several._targets, "update", lambda *frame: InterruptingTracks(update(*frame)))
            with pytest.raises(KeyboardInterrupt):
                several.update(things.frames[5])
        assert on(several, things.frames[1:]) == alone(FUSED)


@each_workers
def test_a_warning_as_an_error_leaves_all(workers, things, alone, started):
    """With warnings turned into errors an update fails as a whole, each time, and a start as well."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        millimeters = Frame(things.frames[0].color, np.full((160, 240), 2000, np.float32))
    with started(FUSED, workers=workers) as several:
        for _ in range(2):
            with pytest.raises(UserWarning, match="expected meters"):
                several.update(millimeters)
            with pytest.raises(UserWarning, match="expected meters"):
                several.add(millimeters, things.boxes[0])
            assert several._targets.ids == {1, 2, 3, 4}  # nobody follows what didn't start
        assert on(several, things.frames[1:]) == alone(FUSED)
