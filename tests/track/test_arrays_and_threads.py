# SPDX-License-Identifier: MIT
"""What every tracker promises of the arrays that it gets and gives, and of threads."""

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import pytest
from tricue import Box, Frame, Track, create
from tricue.scenes import crossing, face_over_clutter, head, overtaking, stress_scene

FRAMES = 10


class Case(NamedTuple):
    """A tracker, a scene's frames for it, and the first box."""

    tracker: str
    keywords: dict[str, Any]
    frames: tuple[Frame, ...]
    box: Box


def face() -> Case:
    """A face over clutter."""
    scene = face_over_clutter(seed=3, frames=FRAMES)
    return Case("color-particle", {"seed": 1}, scene.frames, scene.boxes[0])


def person() -> Case:
    """A person who walks."""
    scene = crossing(seed=2, frames=FRAMES)
    return Case("depth-particle", {"intrinsics": scene.intrinsics, "seed": 1}, scene.frames, scene.boxes[0])


def pair() -> Case:
    """A head before a stereo pair."""
    scene = head(1, FRAMES)
    return Case("stereo-head", {"rig": scene.rig}, scene.frames, scene.boxes[0])


def walk() -> Case:
    """A walker among others before a stereo pair."""
    scene = overtaking(0, FRAMES)
    return Case("flow-depth", {"rig": scene.rig}, scene.frames, scene.boxes[0])


def stress(tracker: str, channels: str) -> Callable[[], Case]:
    """A target that moves fast."""

    def make() -> Case:
        scene = stress_scene("fast", 1, channels=channels)
        return Case(tracker, {}, scene.frames[:FRAMES], scene.boxes[0])

    return make


CASES = {
    "color-particle": face,
    "depth-particle": person,
    "stereo-head": pair,
    "flow-depth, stereo": walk,
    "flow-depth, rgbd": stress("flow-depth", "rgbd"),
    **{f"fused, {each}": stress("fused", each) for each in ("color", "depth", "rgbd", "stereo")},
}


@cache
def made(name: str) -> Case:
    """The case, rendered once."""
    return CASES[name]()


@pytest.fixture(params=CASES)
def case(request: pytest.FixtureRequest) -> Case:
    """A tracker and its scene."""
    return made(request.param)


def followed(case: Case, frames: Iterator[Frame] | None = None) -> list[Track]:
    """The tracks of the frames, by default the case's."""
    tracker, found = create(case.tracker, **case.keywords), list[Track]()
    for frame in case.frames if frames is None else frames:
        found.append(tracker.update(frame) if found else tracker.init(frame, case.box))
    return found


def in_one_buffer(frames: tuple[Frame, ...]) -> Iterator[Frame]:
    """The frames in the same arrays, which are overwritten as soon as the next one is asked for."""
    buffers = {name: getattr(frames[0], name).copy() for name in frames[0].channels}
    for frame in frames:
        for name, buffer in buffers.items():
            buffer[:] = getattr(frame, name)
        yield Frame(**buffers, timestamp=frame.timestamp)
        for buffer in buffers.values():
            buffer[:] = 1


def test_buffers_may_be_overwritten(case: Case) -> None:
    """After a call nothing of the tracker is in the caller's arrays, in any channel."""
    assert followed(case, in_one_buffer(case.frames)) == followed(case)


def test_arrays_stay_as_they_were(case: Case) -> None:
    """What a tracker gave is the same after more updates."""
    tracker = create(case.tracker, **case.keywords)
    given: list[Any] = []
    for number, frame in enumerate(case.frames):
        track = tracker.update(frame) if number else tracker.init(frame, case.box)
        arrays = [getattr(tracker, name, None) for name in ("particles", "mask")]
        given += [each for each in (track.position, track.covariance, *arrays) if each is not None]
        if number == 1:
            kept = [each.copy() for each in given]
    assert all(map(np.array_equal, kept, given))


def test_each_thread_has_its_tracker() -> None:
    """Trackers in threads give the tracks that they give one after the other."""
    cases = [made(name) for name in CASES]
    with ThreadPoolExecutor(len(cases)) as pool:
        together = list(pool.map(followed, cases))
    assert together == list(map(followed, cases))
