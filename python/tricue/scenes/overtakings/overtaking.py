# SPDX-License-Identifier: MIT
"""A walker is overtaken before a turning stereo pair: as in Okada, Shirai and Miura (1996), section 5."""

from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.scenes.arrays import Array, Picture
from tricue.scenes.overtakings import hall as halls
from tricue.scenes.overtakings import plan as overtaking_moves
from tricue.scenes.overtakings.hall import Hall
from tricue.scenes.overtakings.pan import Pan
from tricue.scenes.overtakings.plan import (
    OVERTAKING_FRAME_RATE,
    STORY_FRAMES,
    OvertakingPaths,
    OvertakingPlan,
)
from tricue.scenes.overtakings.truth import LazySequence, WalkGeometry
from tricue.scenes.people.body import Person
from tricue.scenes.people.pedestrian import Outfit, Pedestrian
from tricue.scenes.rendering.depth_sensor import DEPTH_SENSORS
from tricue.scenes.rendering.stereo_camera import Lamp, RayCamera, expose_lit
from tricue.scenes.scene import Events, WalkScene

OVERTAKING_KINDS = ("plain", "varied")
RAYS_PER_PIXEL = {"160x120": 3, "640x480": 2}  # rays a pixel along each axis
MAX_OVERTAKING_FRAMES = 2 * STORY_FRAMES  # frames; the camera turns out of the hall later
MISSING_SHARE, MAX_OVERTAKING_DEPTH = (
    0.02,
    16.0,
)  # share of the pixels without a depth; metres that the depth camera sees
WEARS_COAT = False, True, False  # who overtakes hides the target's legs with one


def overtaking(
    seed: int = 0,
    frames: int = 100,
    camera: str = "160x120",
    *,
    kind: str = "plain",
    depth: bool = False,
    noise: float = 2.0,
) -> WalkScene:
    """A target walks through a hall, is overtaken by somebody nearer, and passes who stands; 15 frames/s.

    frames: up to 200. The story takes 100: less than a tenth of the target is visible about frames 24 to 46,
        nothing or nearly nothing in the middle of them, and it passes who stands at about 74. Fewer cut it
        short, with more everybody walks on and may leave the picture.
    camera: "160x120" or "640x480" pixels. kind: one of OVERTAKINGS;
        "plain": from right to left, all but looks, room and noise the same in each seed; the target passes
            in front of who stands;
        "varied": also the direction, pan (0 to 0.9 pixels a frame in a width of 160), paces, sizes, depths,
            the contrast of the clothes, and whether who stands is in front or behind.
    depth: a depth camera registered to the left one instead of the right one.
    noise: standard deviation in levels of 255, independent in both images; the depth camera's own noise stays
        the same.

    The pair pans after the target with constant velocity. The target and who stands have nearly the same
    depth: 0.3 to 0.45 m apart, some 0.3 pixels of disparity in a width of 160. There is no motion blur and
    no shadow cast.
    """
    _check(frames, camera, kind, noise)
    rng = np.random.default_rng(seed)
    plan = overtaking_moves.PLAIN_PLAN if kind == "plain" else overtaking_moves.sample_plan(rng)
    truth, depths = _world(plan, camera, max(frames, STORY_FRAMES), rng)
    stage = _PanningStage.build(truth, depths, RAYS_PER_PIXEL[camera], rng)
    sights = [truth.sight(index) for index in range(frames)]
    visible = np.array([sight.visible for sight in sights])
    record = _record_depth if depth else _record_stereo
    return WalkScene(
        name=f"overtaking, {kind}, {camera}, seed {seed}",
        frames=tuple(record(stage, frames, noise, rng)),
        boxes=tuple(sight.target.box for sight in sights),
        visible_boxes=tuple(sight.visible_box for sight in sights),
        positions=np.stack([sight.target.position for sight in sights]),
        visible=visible,
        masks=tuple(sight.mask for sight in sights),
        flow=LazySequence(frames, truth.flow),
        disparity=LazySequence(frames, truth.disparity),
        others=tuple(sight.others for sight in sights),
        rig=truth.pan.rig,
        events=_events(visible, round(plan.passing_frame)),
    )


class _PanningStage(NamedTuple):
    """All that is to be drawn, as detailed as the rays of the pair see it."""

    pan: Pan
    eyes: tuple[RayCamera, RayCamera]
    hall: Hall
    people: list[Pedestrian]
    lamp: Lamp  # level frame
    truth: WalkGeometry

    @classmethod
    def build(
        cls, truth: WalkGeometry, depths: tuple[float, float, float], rays: int, rng: np.random.Generator
    ) -> "_PanningStage":
        """depths: at which each one is seen, metres."""
        eyes = RayCamera.pair(truth.pan.rig, rays)
        focal = eyes[0].intrinsics.fx
        people = [person.seen_at(at, focal) for person, at in zip(truth.people, depths, strict=True)]
        direction = rng.uniform([-0.8, -1.0, -1.0], [0.8, -0.4, -0.5])
        lamp = Lamp(direction / np.linalg.norm(direction), rng.uniform(0.5, 0.7))
        return cls(truth.pan, eyes, truth.hall.seen_at(focal), people, lamp, truth)

    def picture(self, eye: RayCamera, index: int) -> Picture:
        """What a camera sees in a frame, before gain and noise."""
        to_camera = self.pan.to_camera(index)
        canvas = self.hall.draw(eye, to_camera)
        lamp = self.lamp._replace(direction=to_camera @ self.lamp.direction)
        for person in self.people:
            eye.draw_ellipsoids(canvas, person.ellipsoids(index, to_camera), lamp)
        return eye.average_rays(canvas)


def _world(
    plan: OvertakingPlan, camera: str, frames: int, rng: np.random.Generator
) -> tuple[WalkGeometry, tuple[float, float, float]]:
    """People on their ways through a hall, and how far away each of them is about, metres."""
    people, paths = _people(plan, camera, frames, rng)
    farthest = max(np.hypot(*paths.target.T).max(), np.hypot(*paths.standing))
    hall = halls.furnish_hall(paths.pan.height, float(farthest), paths.pan.reach, rng)
    return WalkGeometry(paths.pan, hall, people), paths.depths


def _people(
    plan: OvertakingPlan, camera: str, frames: int, rng: np.random.Generator
) -> tuple[list[Pedestrian], OvertakingPaths]:
    """The target, who overtakes, and who stands."""
    target = Person.sample(rng)._replace(build=rng.uniform(1.08, 1.2))
    overtaker = Person(plan.height_ratio * target.height, rng.uniform(1.1, 1.2))
    standing = Person.sample(rng)._replace(build=rng.uniform(0.9, 1.0))
    outfits = [
        Outfit.sample(contrast, coat, rng)
        for contrast, coat in zip(plan.clothes_contrast, WEARS_COAT, strict=True)
    ]
    paths = overtaking_moves.plan_paths(plan, target, camera, frames, rng)
    floor = paths.pan.height
    facing = overtaking_moves.heading_to_camera(paths.standing) + rng.uniform(-0.3, 0.3)
    people = [
        Pedestrian.walk(target, outfits[0], paths.target, floor, OVERTAKING_FRAME_RATE),
        Pedestrian.walk(overtaker, outfits[1], paths.overtaker, floor, OVERTAKING_FRAME_RATE),
        Pedestrian.stand(standing, outfits[2], paths.standing, floor, facing, frames),
    ]
    return people, paths


def _record_stereo(
    stage: _PanningStage, frames: int, noise: float, rng: np.random.Generator
) -> Iterator[Frame]:
    gains = 1.0, rng.uniform(0.95, 1.05)
    for index in range(frames):
        left, right = (
            expose_lit(stage.picture(eye, index), np.full(3, gain), noise, rng)
            for eye, gain in zip(stage.eyes, gains, strict=True)
        )
        yield Frame(left, right=right, timestamp=index / OVERTAKING_FRAME_RATE)


def _record_depth(
    stage: _PanningStage, frames: int, noise: float, rng: np.random.Generator
) -> Iterator[Frame]:
    sensor = replace(
        DEPTH_SENSORS["rgbd"], intrinsics=stage.truth.pan.rig.intrinsics, far=MAX_OVERTAKING_DEPTH
    )
    for index in range(frames):
        color = expose_lit(stage.picture(stage.eyes[0], index), np.ones(3), noise, rng)
        measured = sensor.measure(stage.truth.depth(index), rng, missing=MISSING_SHARE)
        yield Frame(color, measured, timestamp=index / OVERTAKING_FRAME_RATE)


def _events(visible: Array, passing_frame: int) -> Events:
    """When what the story tells happens first; None for what comes after the last frame."""
    hiding, hidden = _first(visible < 0.6), _first(visible < 0.1)
    back = None if hidden is None else _first((visible > 0.2) & (np.arange(len(visible)) > hidden))
    return Events(hiding, hidden, back, passing_frame if passing_frame < len(visible) else None)


def _first(true: NDArray[np.bool_]) -> int | None:
    return int(np.argmax(true)) if true.any() else None


def _check(frames: int, camera: str, kind: str, noise: float) -> None:
    if positive_whole(frames, "frames", "a count") > MAX_OVERTAKING_FRAMES:
        raise ValueError(f"frames: expected at most {MAX_OVERTAKING_FRAMES}, got {frames!r}")
    for value, name, known in ((camera, "camera", tuple(RAYS_PER_PIXEL)), (kind, "kind", OVERTAKING_KINDS)):
        if value not in known:
            raise ValueError(f"{name}: expected one of {', '.join(known)}, got {value!r}")
    if finite(noise, "noise", "levels of 255") < 0:
        raise ValueError(f"noise: expected levels of 255, 0 or more, got {noise!r}")
