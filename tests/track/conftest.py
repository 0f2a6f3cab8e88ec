# SPDX-License-Identifier: MIT
"""Scenes on which the color particle tracker is proved."""

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, ColorParticleTracker, Track
from tricue.camera.frame import FrameLike
from tricue.scenes import Scene, face_over_clutter, photographs
from tricue.scenes.paste import ellipse_mask, expose, paste

Image = NDArray[np.uint8]
Place = tuple[float, float] | None
HEIGHT, WIDTH = 240, 320
FACE = (50, 63)


class Stage(Protocol):
    def __call__(self, places: Sequence[Place], background: str = "coffee", seed: int = 0) -> list[Image]: ...


class Follow(Protocol):
    def __call__(
        self, tracker: ColorParticleTracker, frames: Sequence[FrameLike], box: Box
    ) -> list[Track]: ...


@pytest.fixture(scope="session")
def stage() -> Stage:
    """Frames with the face's corner at each place, None where it is out of the picture."""

    def make(places: Sequence[Place], background: str = "coffee", seed: int = 0) -> list[Image]:
        rng = np.random.default_rng(seed)
        ground = photographs.background(background, HEIGHT, WIDTH, rng).astype(np.float32)
        portrait = photographs.crop(photographs.photograph("astronaut"), photographs.FACE)
        face = photographs.resize(portrait, FACE[1], FACE[0]).astype(np.float32)
        opacity = ellipse_mask(FACE[1], FACE[0], edge=2.0)
        return [
            expose(ground if place is None else paste(ground, face, opacity, *place), 2.0, rng)
            for place in places
        ]

    return make


@pytest.fixture(scope="session")
def follow() -> Follow:
    """Init on the first frame, update on all others: a track a frame."""
    return lambda tracker, frames, box: [tracker.init(frames[0], box), *map(tracker.update, frames[1:])]


@pytest.fixture(scope="session")
def scene() -> Scene:
    """36 frames of the face over clutter."""
    return face_over_clutter(seed=3, frames=36)


@pytest.fixture(scope="session")
def run(scene: Scene, follow: Follow) -> Callable[..., list[Track]]:
    """The tracks of the scene, with a fresh tracker of the given parameters."""
    return lambda **parameters: follow(ColorParticleTracker(**parameters), scene.frames, scene.boxes[0])
