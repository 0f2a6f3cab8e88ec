# SPDX-License-Identifier: MIT
"""A walker is overtaken in front of a panning stereo pair, as in Okada, Shirai, Miura (1996), section 5."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.scenes.arrays import Array, Picture
from tricue.scenes.overtakings.hall import Hall, furnish_hall
from tricue.scenes.overtakings.pan import Pan
from tricue.scenes.overtakings.plan import (
    OVERTAKING_FRAME_RATE,
    PLAIN_PLAN,
    STORY_FRAMES,
    OvertakingPaths,
    OvertakingPlan,
    heading_to_camera,
    plan_paths,
    sample_plan,
)
from tricue.scenes.overtakings.truth import LazySequence, WalkGeometry
from tricue.scenes.people.body import Person, rotation_about_y
from tricue.scenes.people.pedestrian import Outfit, Pedestrian
from tricue.scenes.rendering.depth_sensor import DEPTH_SENSORS
from tricue.scenes.rendering.stereo_camera import RAYS_PER_PIXEL, RayCamera, WhiteLamp, expose_lit
from tricue.scenes.scene import Events, WalkScene
from tricue.scenes.seeds import make_generator

OVERTAKING_KINDS = ("plain", "varied")
MAX_OVERTAKING_FRAMES = 2 * STORY_FRAMES  # later the camera would pan out of the hall
MAX_VERGENCE = 20.0  # degrees
MISSING_SHARE = 0.02  # of the depth camera's pixels
MAX_OVERTAKING_DEPTH = 16.0  # meters, of the depth camera's range
WEARS_COAT = False, True, False  # target, overtaker (whose coat hides the target's legs), standing person


def overtaking(
    seed: int = 0,
    frames: int = 100,
    camera: str = "160x120",
    *,
    kind: str = "plain",
    depth: bool = False,
    noise: float = 2.0,
    vergence: float = 0.0,
) -> WalkScene:
    """A target walks through a hall, is overtaken, and passes a standing person; 15 frames per second.

    frames: up to 200. All events happen within 100: less than a tenth of the target is visible in about
        frames 24 to 46, and nearly nothing in the middle of them; it passes the standing person at about
        frame 74. After that everybody walks on and may leave the image.
    camera: "160x120" or "640x480" pixels. kind: one of OVERTAKING_KINDS;
        "plain": from right to left; seeds differ only in looks, room and noise, and the target passes in
            front of the standing person;
        "varied": seeds also differ in direction, pan (0 to 0.9 pixels per frame in a width of 160), speeds,
            sizes, depths, contrast of the clothes, and whether the standing person is in front or behind.
    depth: a depth camera registered to the left camera, instead of the right camera.
    noise: standard deviation in levels of 255, independent in both images; it doesn't change the depth
        camera's noise.

    vergence: degrees by which the right camera is turned inward, 0 to 20. The truth stays that of the left
        camera, and disparities stay those of a parallel pair.

    The pair pans with the target at constant velocity. The target and the standing person are only 0.3 to
    0.45 m apart in depth, about 0.3 pixels of disparity at a width of 160. There is no motion blur and no
    cast shadow. ValueError or TypeError names the argument that is wrong.
    """
    _check(frames, camera, kind, noise, vergence)
    rng = make_generator(seed)
    plan = PLAIN_PLAN if kind == "plain" else sample_plan(rng)
    geometry, depths = _sample_geometry(plan, camera, max(frames, STORY_FRAMES), rng)
    stage = _PanningStage.build(geometry, depths, RAYS_PER_PIXEL[camera], rng)
    stage = stage._replace(vergence=math.radians(vergence))
    truths = [geometry.truth_at(index) for index in range(frames)]
    visible = np.array([truth.visible for truth in truths])
    record = _record_depth if depth else _record_stereo
    return WalkScene(
        name=f"overtaking, {kind}, {camera}, seed {seed}",
        frames=tuple(record(stage, frames, noise, rng)),
        boxes=tuple(truth.target.box for truth in truths),
        visible_boxes=tuple(truth.visible_box for truth in truths),
        positions=np.stack([truth.target.position for truth in truths]),
        visible=visible,
        masks=tuple(truth.mask for truth in truths),
        flow=LazySequence(frames, geometry.flow),
        disparity=LazySequence(frames, geometry.disparity),
        others=tuple(truth.others for truth in truths),
        rig=geometry.pan.rig,
        vergence=float(vergence),
        events=_events(visible, round(plan.passing_frame)),
    )


class _PanningStage(NamedTuple):
    """The scene to render, with the texture levels that fit the cameras' rays."""

    pan: Pan
    cameras: tuple[RayCamera, RayCamera]
    hall: Hall
    people: list[Pedestrian]
    lamp: WhiteLamp  # level frame
    geometry: WalkGeometry
    vergence: float = 0.0  # radians

    @classmethod
    def build(
        cls, geometry: WalkGeometry, depths: tuple[float, float, float], rays: int, rng: np.random.Generator
    ) -> "_PanningStage":
        """Set up the scene. depths: the approximate depths of the three people, meters."""
        cameras = RayCamera.pair(geometry.pan.rig, rays)
        focal = cameras[0].intrinsics.fx
        people = [person.at_detail(at, focal) for person, at in zip(geometry.people, depths, strict=True)]
        direction = rng.uniform([-0.8, -1.0, -1.0], [0.8, -0.4, -0.5])
        lamp = WhiteLamp(direction / np.linalg.norm(direction), rng.uniform(0.5, 0.7))
        return cls(geometry.pan, cameras, geometry.hall.at_detail(focal), people, lamp, geometry)

    def render(self, camera: RayCamera, index: int) -> Picture:
        """Render a frame for a camera, before gain and noise."""
        to_camera, shift = self.pan.to_camera(index), np.zeros(3)
        if self.vergence and camera.offset:  # the right camera turns about its own center
            turned = rotation_about_y(self.vergence)
            shift = turned @ [-camera.offset, 0.0, 0.0]
            to_camera, camera = turned @ to_camera, camera._replace(offset=0.0)
        canvas = self.hall.render(camera, to_camera, shift)
        lamp = self.lamp._replace(direction=to_camera @ self.lamp.direction)
        for person in self.people:
            camera.draw_ellipsoids(canvas, person.ellipsoids(index, to_camera, shift), lamp)
        return camera.average_rays(canvas)


def _sample_geometry(
    plan: OvertakingPlan, camera: str, frames: int, rng: np.random.Generator
) -> tuple[WalkGeometry, tuple[float, float, float]]:
    """People on their paths through a hall, and the approximate distance of each, meters."""
    people, paths = _sample_people(plan, camera, frames, rng)
    farthest = max(np.hypot(*paths.target.T).max(), np.hypot(*paths.standing))
    hall = furnish_hall(paths.pan.height, float(farthest), paths.pan.reach, rng)
    return WalkGeometry(paths.pan, hall, people), paths.depths


def _sample_people(
    plan: OvertakingPlan, camera: str, frames: int, rng: np.random.Generator
) -> tuple[list[Pedestrian], OvertakingPaths]:
    """The target, the overtaker and the standing person, and their paths."""
    target = Person.sample(rng)._replace(build=rng.uniform(1.08, 1.2))
    overtaker = Person(plan.height_ratio * target.height, rng.uniform(1.1, 1.2))
    standing = Person.sample(rng)._replace(build=rng.uniform(0.9, 1.0))
    outfits = [
        Outfit.sample(contrast, coat, rng)
        for contrast, coat in zip(plan.clothes_contrast, WEARS_COAT, strict=True)
    ]
    paths = plan_paths(plan, target, camera, frames, rng)
    floor = paths.pan.height
    facing = heading_to_camera(paths.standing) + rng.uniform(-0.3, 0.3)
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
            expose_lit(stage.render(camera, index), np.full(3, gain), noise, rng)
            for camera, gain in zip(stage.cameras, gains, strict=True)
        )
        yield Frame(left, right=right, timestamp=index / OVERTAKING_FRAME_RATE)


def _record_depth(
    stage: _PanningStage, frames: int, noise: float, rng: np.random.Generator
) -> Iterator[Frame]:
    sensor = replace(
        DEPTH_SENSORS["rgbd"], intrinsics=stage.geometry.pan.rig.intrinsics, far=MAX_OVERTAKING_DEPTH
    )
    for index in range(frames):
        color = expose_lit(stage.render(stage.cameras[0], index), np.ones(3), noise, rng)
        measured = sensor.measure(stage.geometry.depth(index), rng, missing=MISSING_SHARE)
        yield Frame(color, measured, timestamp=index / OVERTAKING_FRAME_RATE)


def _events(visible: Array, passing_frame: int) -> Events:
    """The first frame of each event; None for an event after the last frame."""
    hiding, hidden = _first(visible < 0.6), _first(visible < 0.1)
    back = None if hidden is None else _first((visible > 0.2) & (np.arange(len(visible)) > hidden))
    return Events(hiding, hidden, back, passing_frame if passing_frame < len(visible) else None)


def _first(true: NDArray[np.bool_]) -> int | None:
    return int(np.argmax(true)) if true.any() else None


def _check(frames: int, camera: str, kind: str, noise: float, vergence: float) -> None:
    if positive_whole(frames, "frames", "a count") > MAX_OVERTAKING_FRAMES:
        raise ValueError(f"frames: expected at most {MAX_OVERTAKING_FRAMES}, got {frames!r}")
    for value, name, known in ((camera, "camera", tuple(RAYS_PER_PIXEL)), (kind, "kind", OVERTAKING_KINDS)):
        if value not in known:
            raise ValueError(f"{name}: expected one of {', '.join(known)}, got {value!r}")
    if finite(noise, "noise", "levels of 255") < 0:
        raise ValueError(f"noise: expected levels of 255, 0 or more, got {noise!r}")
    if not 0 <= finite(vergence, "vergence", "degrees") <= MAX_VERGENCE:
        raise ValueError(f"vergence: expected 0 to {MAX_VERGENCE} degrees, got {vergence!r}")
