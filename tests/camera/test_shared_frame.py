# SPDX-License-Identifier: MIT
import gc
import weakref

import numpy as np
import pytest
from tricue import Frame
from tricue.camera.shared_frame import SharedFrame, messages_of, once, warn_of_frame
from tricue.track.fused.prepared_frame import prepare_frame

IMAGE = np.zeros((6, 8, 3), np.uint8)


def counted(frame: Frame, calls: list[Frame], add: int) -> int:
    """The frame's height and something, and a list that tells how often that was asked for."""
    calls.append(frame)
    return frame.color.shape[0] + add


def test_it_is_the_frame():
    """It has the frame's own channels, without a copy, and is a frame."""
    frame = Frame(IMAGE, depth=np.ones((6, 8)), timestamp=2.0)
    shared = SharedFrame.of(frame)
    assert isinstance(shared, Frame)
    assert (shared.color, shared.depth, shared.right) == (frame.color, frame.depth, None)
    assert (shared.channels, shared.timestamp, shared.pose) == (("color", "depth"), 2.0, None)


def test_the_same_is_computed_once():
    """For the same function and arguments, of a shared frame; each time of another."""
    calls = _Calls()
    shared = SharedFrame.of(Frame(IMAGE))
    assert [once(shared, counted, calls, add) for add in (1, 1, 2, 1)] == [7, 7, 8, 7]
    assert len(calls) == 2
    assert [once(Frame(IMAGE), counted, calls, 1) for _ in range(2)] == [7, 7]
    assert len(calls) == 4


class _Calls(list):  # type: ignore[type-arg]
    """A list that can be an argument of ``once``."""

    __hash__ = object.__hash__  # type: ignore[assignment]


def test_an_error_is_raised_each_time():
    """What failed isn't kept."""

    def fail(_: Frame) -> None:
        raise ValueError("no")

    shared = SharedFrame.of(Frame(IMAGE))
    for _ in range(2):
        with pytest.raises(ValueError, match="no"):
            once(shared, fail)


def test_warnings_are_collected():
    """Those of a shared frame are kept, each once; of any other they are shown, at the line asked for."""
    shared = SharedFrame.of(Frame(IMAGE))
    for text in ("a", "b", "a"):
        warn_of_frame(messages_of(shared), text, 1)
    assert shared.messages == ["a", "b"]
    with pytest.warns(UserWarning, match="c") as told:
        warn_of_frame(messages_of(Frame(IMAGE)), "c", 1)
    assert told[0].filename == __file__


def test_it_goes_when_nobody_has_it():
    """What the fused tracker keeps of it doesn't keep it: no garbage collector is needed for its images."""
    image = IMAGE.copy()
    shared = SharedFrame.of(Frame(image))
    assert prepare_frame(shared, None, (None, None), True).color is shared.color
    gone = weakref.ref(shared.color)
    gc.disable()
    try:
        del shared, image
        assert gone() is None
    finally:
        gc.enable()
