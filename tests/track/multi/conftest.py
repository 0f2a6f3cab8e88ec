# SPDX-License-Identifier: MIT
"""Several textured things that move before clutter."""

from collections.abc import Callable
from typing import Any, NamedTuple

import cv2
import numpy as np
import pytest
from tricue import Box, Frame, MultiTracker, Track, create

HEIGHT, WIDTH = 160, 240
FRAMES = 10


class Film(NamedTuple):
    """Frames, and the box of each thing in the first."""

    frames: tuple[Frame, ...]
    boxes: tuple[Box, ...]


@pytest.fixture(scope="session")
def things() -> Film:
    """Four things of 24x32 pixels before blurred noise, which move up to 2 pixels a frame."""
    rng = np.random.default_rng(0)
    ground = cv2.resize(rng.integers(0, 256, (HEIGHT // 8, WIDTH // 8, 3), np.uint8), (WIDTH, HEIGHT))
    pictures = [
        cv2.resize(rng.integers(0, 256, (6, 4, 3), np.uint8), (24, 32), interpolation=cv2.INTER_CUBIC)
        for _ in range(4)
    ]
    start, speed = np.array([[20, 20], [90, 100], [150, 30], [190, 110]]), rng.integers(-2, 3, (4, 2))
    frames = []
    for index in range(FRAMES):
        image = ground.copy()
        for (x, y), picture in zip(start + index * speed, pictures, strict=True):
            image[y : y + 32, x : x + 24] = picture
        frames.append(Frame(image, timestamp=index / 30))
    return Film(tuple(frames), tuple(Box(float(x), float(y), 24.0, 32.0) for x, y in start))


Kinds = tuple[str, ...]


@pytest.fixture(scope="session")
def alone(things: Film) -> Callable[[Kinds], list[dict[int, Track]]]:
    """Tracks of trackers of these kinds that know nothing of each other, by a MultiTracker's ids."""

    def follow(kinds: Kinds) -> list[dict[int, Track]]:
        trackers = {number: create(kind) for number, kind in enumerate(kinds, 1)}
        for number, tracker in trackers.items():
            tracker.init(things.frames[0], things.boxes[number - 1])
        return [
            {number: tracker.update(frame) for number, tracker in trackers.items()}
            for frame in things.frames[1:]
        ]

    return follow


@pytest.fixture(scope="session")
def started(things: Film) -> Callable[..., MultiTracker]:
    """A MultiTracker with a target of each kind on the things' first frame."""

    def start(kinds: Kinds, **keywords: Any) -> MultiTracker:
        several = MultiTracker(**keywords)
        for kind, box in zip(kinds, things.boxes, strict=False):
            several.add(things.frames[0], box, kind)
        return several

    return start
