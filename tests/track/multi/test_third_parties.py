# SPDX-License-Identifier: MIT
"""Third parties' trackers, errors and boxes in worker processes, which may not be able to load them."""

import sys
import threading
from pathlib import Path

import numpy as np
import pytest
from tricue import Box, Frame, FusedTracker, MultiTracker
from tricue.track.multi.worker import _portable

from tests.track.multi.kinds import FUSED


class Odd(Exception):  # noqa: N818 (a third party's)
    def __init__(self, a: int, b: int) -> None:
        super().__init__(f"{a} and {b}")
        self.lock = threading.Lock()


def test_errors_that_can_not_be_pickled_are_told():
    """A third party's may hold anything."""
    error = _portable(Odd(1, 2))
    assert type(error) is RuntimeError
    assert str(error) == "Odd: 1 and 2"
    assert str(_portable(ValueError("x"))) == "x"


class Previous:
    """A third party's: it keeps the last image, and tells how much the new one differs from it."""

    def init(self, image, box) -> None:
        self.last = image

    def update(self, image) -> tuple[tuple[float, ...], float]:
        change = float(np.abs(image.astype(int) - self.last).mean())
        self.last = image
        return (change, 0.0, 5.0, 5.0), 0.5


@pytest.mark.parametrize("workers", [1, 2])
def test_a_third_partys_tracker_may_keep_images(workers, things):
    """Its tracks are the same in another process, which sees the frames in memory that is used again."""
    name = f"{__name__}:Previous"
    expected = [
        float(np.abs(new.color.astype(int) - old.color).mean())
        for old, new in zip(things.frames[:3], things.frames[1:4], strict=True)
    ]
    with MultiTracker(name, workers=workers) as several:
        for box in things.boxes[:2]:
            several.add(things.frames[0], box)
        for frame, change in zip(things.frames[1:4], expected, strict=True):
            assert [track.box[0] for track in several.update(frame).values()] == [change] * 2


class Drawing:
    """A third party's: it blackens the image, as others draw boxes into it."""

    def init(self, image, box) -> None:
        self.box = box
        self.update(image)

    def update(self, image) -> tuple[float, ...]:
        image[:] = 0
        return self.box


@pytest.mark.parametrize("workers", [1, 2])
def test_a_third_partys_tracker_may_draw_into_images(workers, things):
    """The other targets, in its process and in the other one, and the caller still have the image."""
    frames = [Frame(each.color.copy()) for each in things.frames[:4]]
    alone = FusedTracker()
    expected = [alone.init(things.frames[0].color, things.boxes[0])]
    expected += [alone.update(each.color) for each in things.frames[1:4]]
    with MultiTracker(workers=workers) as several:
        for name in (f"{__name__}:Drawing", "fused") * 2:
            several.add(frames[0], things.boxes[0], name)
        for frame, track in zip(frames[1:], expected[1:], strict=True):
            found = several.update(frame)
            assert found[2] == found[4] == track
    assert all(np.array_equal(a.color, b.color) for a, b in zip(frames, things.frames, strict=False))


class Locked(Previous):
    """One that can't go to another process."""

    def __init__(self) -> None:
        self.lock = threading.Lock()


def test_a_tracker_that_can_not_be_pickled_names_the_option(things):
    """The targets that are there go on."""
    with MultiTracker(f"{__name__}:Previous", workers=2) as several:
        several.add(things.frames[0], things.boxes[0])
        with pytest.raises(TypeError, match=r"^workers: expected 1, .*; cannot pickle '_thread.lock'"):
            several.add(things.frames[0], things.boxes[1], f"{__name__}:Locked")
        assert list(several.update(things.frames[1])) == [1]


def test_a_tracker_that_can_not_be_loaded_names_the_option(things, monkeypatch):
    """One of the user's script, which a worker doesn't run; the worker's targets go on."""
    own = type("Own", (Previous,), {"__module__": "__main__"})
    monkeypatch.setattr(sys.modules["__main__"], "Own", own, raising=False)
    with MultiTracker(f"{__name__}:Previous", workers=2) as several:
        for box in things.boxes[:3]:
            several.add(things.frames[0], box)
        with pytest.raises(TypeError, match=r"^workers: expected 1, .*; Can't get attribute 'Own'"):
            several.add(things.frames[0], things.boxes[3], "__main__:Own")
        assert list(several.update(things.frames[1])) == [1, 2, 3]


def test_a_box_may_be_of_a_class_of_the_script(things, monkeypatch):
    """A worker that can't load the class gets the box all the same."""
    own = type("Own", (Box,), {"__module__": "__main__"})
    monkeypatch.setattr(sys.modules["__main__"], "Own", own, raising=False)
    with MultiTracker(workers=2) as several:
        for box in things.boxes[:2]:
            several.add(things.frames[0], own(*box))
        assert list(several.update(things.frames[1])) == [1, 2]


def test_who_keeps_images_may_share_a_worker(things):
    """One third party's tracker among others in a process sees images of its own, too."""
    change = [
        float(np.abs(new.color.astype(int) - old.color).mean())
        for old, new in zip(things.frames[:3], things.frames[1:4], strict=True)
    ]
    with MultiTracker(workers=2) as several:
        for box, kind in zip(things.boxes, ("fused", f"{__name__}:Previous", "fused", "fused"), strict=True):
            several.add(things.frames[0], box, kind)
        assert [len(each.ids) for each in several._targets._parts] == [2, 2]
        assert [several.update(frame)[2].box[0] for frame in things.frames[1:4]] == change


def test_a_path_may_be_among_the_folders_of_modules(monkeypatch, started, things, alone):
    """Of ``sys.path``, to which some add a pathlib.Path; workers look for modules there, too."""
    monkeypatch.setattr(sys, "path", [*sys.path, Path("somewhere")])
    with started(FUSED, workers=2) as several:
        assert several.update(things.frames[1]) == alone(FUSED)[0]
