# SPDX-License-Identifier: MIT
"""A walker in front of a stereo pair on a pan-tilt head: each frame is rendered from where the head looks.

The level frame is fixed to the room, with the left camera at its origin: x right, y down, z forward, meters.
Both axes of the head go through that camera's center.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.numbers import positive_whole
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.scenes.arrays import Array
from tricue.scenes.overtakings.hall import Hall, furnish_hall
from tricue.scenes.overtakings.pan import Pan
from tricue.scenes.overtakings.plan import heading_to_camera
from tricue.scenes.overtakings.truth import FrameTruth, WalkGeometry
from tricue.scenes.pan_tilt.head import HeadLimits
from tricue.scenes.people.body import Person
from tricue.scenes.people.pedestrian import Outfit, Pedestrian
from tricue.scenes.rendering.stereo_camera import RAYS_PER_PIXEL, RayCamera, WhiteLamp, expose_lit
from tricue.scenes.seeds import make_generator

PAN_TILT_RATE = 15.0  # frames per second, as in the paper's system
WIDTH, HEIGHT = 160, 120  # pixels
RAYS = RAYS_PER_PIXEL[f"{WIDTH}x{HEIGHT}"]
FIELD_OF_VIEW = 32.0  # degrees
TARGET_HEIGHT, TARGET_DISPARITY = 74.0, 5.0  # pixels
DEPTH_SWING = 0.5  # meters by which the target's depth varies to each side
CROSSING_DEPTH_RATIO = 1.8  # the target's depth divided by the crossing person's
STANDING_OFFSET = 0.4  # meters behind the target's path
CROSSING_SPEED = 1.2  # m/s
MEETING_PHASE = 0.35 * math.pi  # of the target's walk, at which somebody crosses in front
CLOTHES_CONTRAST = 0.25
NOISE = 2.0  # levels of 255
START_ERROR = math.radians(1.5)  # of the first view, on each axis
MAX_VIEW_ANGLE = math.radians(60.0)  # from the optical axis, beyond which people aren't rendered


class PanTiltTruth(NamedTuple):
    """The truth of a frame.

    seen: the target's box, position and visible pixels, as in :class:`tricue.scenes.WalkScene`. direction:
    (2,) pan and tilt, radians, that would put the center of its box in the middle of the image.
    """

    seen: FrameTruth
    direction: Array


@dataclass(frozen=True, slots=True, eq=False)
class PanTiltScene:
    """A target walks to and fro over more than the camera's angle of view.

    The same arguments give the same bits.

    rig: the head's stereo pair. limits: the head's. start: (2,) pan and tilt of the first frame, radians.
    """

    name: str
    frames: int
    rate: float
    rig: StereoRig
    limits: HeadLimits
    start: Array
    seed: int
    _hall: Hall
    _people: tuple[Pedestrian, ...]  # the target first
    _lamp: WhiteLamp
    _height: float

    @property
    def first_box(self) -> Box:
        """The target's box in the first frame, seen from ``start``."""
        return self.truth(0, *self.start.tolist()).seen.target.box

    def look(self, index: int, pan: float, tilt: float) -> Frame:
        """What the pair sees in a frame at these angles, radians; with a timestamp."""
        rng = np.random.default_rng([self.seed, index])
        view = self._view(pan, tilt)
        to_camera = view.to_camera(0)
        lamp = self._lamp._replace(direction=to_camera @ self._lamp.direction)
        images = []
        for camera in RayCamera.pair(self.rig, RAYS):
            canvas = self._hall.render(camera, to_camera)
            for person in self._people:
                camera.draw_ellipsoids(canvas, person.ellipsoids(index, to_camera), lamp)
            images.append(expose_lit(camera.average_rays(canvas), np.ones(3), NOISE, rng))
        return Frame(images[0], right=images[1], timestamp=index / self.rate)

    def truth(self, index: int, pan: float, tilt: float) -> PanTiltTruth:
        """The truth in a frame at these angles."""
        view = self._view(pan, tilt)
        to_camera = view.to_camera(0)
        target, *others = (person._replace(parts=[person.parts[index]]) for person in self._people)
        near = [each for each in others if _is_ahead(each, to_camera)]
        seen = WalkGeometry(view, self._hall, [target, *near]).truth_at(0)
        camera, (x, y) = self.rig.intrinsics, seen.target.box.center
        ray = np.array([(x - 0.5 - camera.cx) / camera.fx, (y - 0.5 - camera.cy) / camera.fy, 1.0])
        right, down, ahead = (to_camera.T @ ray).tolist()
        direction = np.array([math.atan2(right, ahead), math.atan2(-down, math.hypot(right, ahead))])
        return PanTiltTruth(seen, direction)

    def _view(self, pan: float, tilt: float) -> Pan:
        return Pan(self.rig, self._height, np.array([pan]), tilt)


def pan_tilt_scene(
    seed: int = 0, frames: int = 180, *, crossed: bool = False, limits: HeadLimits | None = None
) -> PanTiltScene:
    """A walker in front of a stereo pair on a pan-tilt head, 160x120, 15 frames per second.

    The target walks about 6.4 m away over 50 to 70 degrees, at up to 0.9 to 1.2 m/s, and turns around after
    140 to 210 frames; the camera sees 32 degrees of that. Halfway it passes somebody who stands behind its
    path.

    crossed: whether somebody nearer walks the other way and hides the target for some frames. limits: the
    head's.
    """
    positive_whole(frames, "frames", "a count")
    rng = make_generator(seed)
    target = Person.sample(rng)._replace(build=rng.uniform(1.08, 1.2))
    camera = Intrinsics.from_fov(WIDTH, HEIGHT, FIELD_OF_VIEW)
    depth = target.height * camera.fx / TARGET_HEIGHT
    height = rng.uniform(1.0, 1.12)
    walk = _Walk.sample(depth, rng)
    people = _people(target, walk, height, frames, crossed, rng)
    half = math.radians(FIELD_OF_VIEW / 2) + START_ERROR
    hall = furnish_hall(height, walk.farthest, (-walk.reach - half, walk.reach + half), rng)
    light = rng.uniform([-0.8, -1.0, -1.0], [0.8, -0.4, -0.5])
    level = np.array([-walk.side * walk.reach, math.atan2(target.height / 2 - height, depth)])
    return PanTiltScene(
        name=f"pan-tilt head, {'crossed, ' if crossed else ''}seed {seed}",
        frames=frames,
        rate=PAN_TILT_RATE,
        rig=StereoRig(camera, TARGET_DISPARITY * depth / camera.fx),
        limits=limits or HeadLimits(),
        start=level + START_ERROR * rng.choice([-1, 1], 2),
        seed=seed,
        _hall=hall.at_detail(RAYS * camera.fx),
        _people=tuple(person.at_detail(at, RAYS * camera.fx) for person, at in people),
        _lamp=WhiteLamp(light / np.linalg.norm(light), rng.uniform(0.5, 0.7)),
        _height=height,
    )


class _Walk(NamedTuple):
    """The target's walk, to and fro on a part of a flat ellipse around the camera."""

    depth: float  # meters, on average
    reach: float  # radians, to each side
    side: int  # 1 from left to right at first, -1 from right to left
    turn: float  # rad/s, speed of the phase

    @classmethod
    def sample(cls, depth: float, rng: np.random.Generator) -> "_Walk":
        reach = math.radians(rng.uniform(25, 35))
        return cls(depth, reach, int(rng.choice([-1, 1])), rng.uniform(0.9, 1.2) / (depth * reach))

    @property
    def farthest(self) -> float:
        """The largest distance of the path or of the standing person, meters."""
        return self.depth + DEPTH_SWING + STANDING_OFFSET

    def path(self, frames: int) -> Array:
        """The places (M, 2), x and z."""
        phase = self.turn * np.arange(frames) / PAN_TILT_RATE
        return _on_floor(-self.side * self.reach * np.cos(phase), self.depth + DEPTH_SWING * np.sin(phase))

    def crossing(self, frames: int) -> Array:
        """The path (M, 2) of the person who crosses in front of the target, before it is halfway."""
        nearer = self.depth / CROSSING_DEPTH_RATIO
        bearing = -self.side * self.reach * math.cos(MEETING_PHASE)
        seconds = np.arange(frames) / PAN_TILT_RATE - MEETING_PHASE / self.turn
        across = nearer * math.tan(bearing) - self.side * CROSSING_SPEED * seconds
        return np.stack([across, np.full(frames, nearer)], axis=1)


def _people(
    target: Person, walk: _Walk, floor: float, frames: int, crossed: bool, rng: np.random.Generator
) -> list[tuple[Pedestrian, float]]:
    """The target, the standing and the crossing person, each with their distance in meters."""
    outfits = [Outfit.sample(CLOTHES_CONTRAST, False, rng) for _ in range(3)]
    standing = Person.sample(rng)._replace(build=rng.uniform(0.9, 1.0))
    crossing = Person(target.height * rng.uniform(1.0, 1.05), rng.uniform(1.1, 1.2))
    place = np.array([0.0, walk.farthest])
    facing = heading_to_camera(place)
    people = [
        (Pedestrian.walk(target, outfits[0], walk.path(frames), floor, PAN_TILT_RATE), walk.depth),
        (Pedestrian.stand(standing, outfits[1], place, floor, facing, frames), walk.farthest),
    ]
    if crossed:
        path = walk.crossing(frames)
        people.append((Pedestrian.walk(crossing, outfits[2], path, floor, PAN_TILT_RATE), float(path[0, 1])))
    return people


def _on_floor(bearing: Array, distance: Array) -> Array:
    """Positions (M, 2), x and z, from bearings (M,), radians from z toward x, and distances (M,), meters."""
    return np.stack([np.sin(bearing) * distance, np.cos(bearing) * distance], axis=1)


def _is_ahead(person: Pedestrian, to_camera: Array) -> bool:
    """Whether a person is in or near the view: not beside or behind the camera."""
    x, _, z = (to_camera @ person.parts[0].centers.mean(axis=0)).tolist()
    return abs(math.atan2(x, z)) < MAX_VIEW_ANGLE
