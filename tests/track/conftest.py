# SPDX-License-Identifier: MIT
"""Scenes on which the particle, the stereo head and the flow and depth trackers are proved."""

import functools
from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, ColorParticleTracker, DepthParticleTracker, FlowDepthTracker, StereoHeadTracker, Track
from tricue.camera.frame import FrameLike
from tricue.scenes import (
    DepthScene,
    Scene,
    StereoScene,
    WalkScene,
    crossing,
    face_over_clutter,
    head,
    overtaking,
    walker,
)
from tricue.scenes.rendering import photographs
from tricue.scenes.rendering.paste import ellipse_mask, expose, paste
from tricue.track.depth_objects.objects import DISTRIBUTION_BINS, Objects

pytest.register_assert_rewrite("bad_input_cases")  # its asserts tell as much as a test's

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
        ground = photographs.crop_background(background, HEIGHT, WIDTH, rng).astype(np.float32)
        portrait = photographs.crop(photographs.load_photograph("astronaut"), photographs.ASTRONAUT_FACE)
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
def scene(rendered: Callable[..., Scene]) -> Scene:
    """36 frames of the face over clutter."""
    return rendered(face_over_clutter, seed=3, frames=36)


@pytest.fixture(scope="session")
def run(scene: Scene, follow: Follow) -> Callable[..., list[Track]]:
    """The tracks of the scene, with a fresh tracker of the given parameters."""
    return lambda **parameters: follow(ColorParticleTracker(**parameters), scene.frames, scene.boxes[0])


@pytest.fixture(scope="session")
def walkers(rendered: Callable[..., DepthScene]) -> list[DepthScene]:
    """Four people who walk alone for six seconds."""
    return [rendered(walker, seed) for seed in range(4)]


@pytest.fixture(scope="session")
def crossings(rendered: Callable[..., DepthScene]) -> list[DepthScene]:
    """Six people whom somebody nearer hides, in six seconds each."""
    return [rendered(crossing, seed) for seed in range(6)]


@pytest.fixture(scope="session")
def passing(rendered: Callable[..., DepthScene]) -> DepthScene:
    """36 frames of somebody who is hidden half way."""
    return rendered(crossing, seed=2, frames=36)


@pytest.fixture(scope="session")
def pass_by(passing: DepthScene, follow: Follow) -> Callable[..., list[Track]]:
    """The tracks of that scene, with a fresh depth tracker of the given parameters."""
    return lambda **parameters: follow(
        DepthParticleTracker(intrinsics=passing.intrinsics, **parameters), passing.frames, passing.boxes[0]
    )


@pytest.fixture(scope="session")
def objects_of() -> Callable[..., Objects]:
    """Objects of the given states (C, 5), which fill 55 % of their boxes; cut (C, 4) nowhere unless told."""

    def make(states: Sequence[Sequence[float]], cut: Sequence[Sequence[int]] | None = None) -> Objects:
        five = np.array(states, np.float64).reshape(-1, 5)
        even = np.full((len(five), DISTRIBUTION_BINS), 1 / DISTRIBUTION_BINS, np.float32)
        area = 0.55 * five[:, 3:].prod(axis=1)
        return Objects(
            measured=np.column_stack([five, np.zeros((len(five), 2)), area]),
            cut=np.zeros((len(five), 4), np.bool_) if cut is None else np.array(cut, np.bool_),
            columns=even,
            rows=even,
        )

    return make


@pytest.fixture(scope="session")
def heads(rendered: Callable[..., StereoScene]) -> Callable[..., StereoScene]:
    """Scenes of a head before a stereo pair, by the arguments of ``head``; each is made once."""
    return functools.partial(rendered, head)


@pytest.fixture(scope="session")
def covered(heads: Callable[..., StereoScene]) -> StereoScene:
    """45 frames of a head that a hand covers half way."""
    return heads(1, 45, kind="hidden")


@pytest.fixture(scope="session")
def cover_up(covered: StereoScene, follow: Follow) -> Callable[..., list[Track]]:
    """The tracks of that scene, with a fresh stereo tracker of the given parameters."""
    return lambda **parameters: follow(
        StereoHeadTracker(rig=covered.rig, **parameters), covered.frames, covered.boxes[0]
    )


@pytest.fixture(scope="session")
def overtakings(rendered: Callable[..., WalkScene]) -> Callable[..., WalkScene]:
    """Scenes of a walker who is overtaken, by the arguments of ``overtaking``; each is made once."""
    return functools.partial(rendered, overtaking)


@pytest.fixture(scope="session")
def overtaken(overtakings: Callable[..., WalkScene]) -> WalkScene:
    """55 frames of a walker whom somebody nearer hides in the second quarter."""
    return overtakings(0, 55)


@pytest.fixture(scope="session")
def walk_on(overtaken: WalkScene, follow: Follow) -> Callable[..., list[Track]]:
    """The tracks of that scene, with a fresh flow and depth tracker of the given parameters."""
    return lambda **parameters: follow(
        FlowDepthTracker(rig=overtaken.rig, **parameters), overtaken.frames, overtaken.boxes[0]
    )
