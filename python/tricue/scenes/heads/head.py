# SPDX-License-Identifier: MIT
"""A head in front of a stereo pair, as in Moreno, Tarrida, Andrade-Cetto and Sanfeliu (2002), section 5."""

from typing import NamedTuple

import numpy as np

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.scenes.arrays import Array
from tricue.scenes.heads import moves as head_moves
from tricue.scenes.heads.actor import Actor, PosedActor
from tricue.scenes.heads.moves import HandMotion, HeadMotion, HeadRange
from tricue.scenes.heads.room import StereoRoom, furnish_room, render_room
from tricue.scenes.pairs import check_pair
from tricue.scenes.rendering.depth_view import MountedCamera
from tricue.scenes.rendering.ellipsoids import Ellipsoids
from tricue.scenes.rendering.stereo_camera import (
    RAYS_PER_PIXEL,
    DrawnEllipsoid,
    RayCamera,
    RayImage,
    TexturedEllipsoid,
    WhiteLamp,
    expose_lit,
)
from tricue.scenes.scene import StereoScene
from tricue.scenes.seeds import make_generator

HEAD_KINDS = ("normal", "distractor", "turning", "jump", "ramp", "hidden")
MIN_HEAD_DISTANCE, MAX_HEAD_DISTANCE = 0.9, 4.05  # meters, of the head's center
HIDDEN_HEAD_DISTANCES = 1.0, 2.1  # the same, in scenes with a hand in front
RADIUS = 0.13  # meters, around a head's center


def head(
    seed: int = 0,
    frames: int = 100,
    camera: str = "160x120",
    *,
    kind: str = "normal",
    light: float = 0.3,
    noise: float = 2.0,
) -> StereoScene:
    """A person walks in front of a stereo pair, 0.8 to 4 m away, in a cluttered room; 30 frames per second.

    camera: "160x120" or "640x480" pixels. kind: one of HEAD_KINDS;
        "normal": the face stays visible, the light varies smoothly;
        "distractor": as "normal", and the head passes in front of skin-colored things;
        "turning": as "normal", and the person turns around, so that only hair is visible for a while;
        "jump": the light changes abruptly every 10 to 20 frames;
        "ramp": the light falls linearly from 1 to 0.5 within 100 frames;
        "hidden": as "normal", and a hand in front of the head, which is then at 1 to 2.1 m, hides it
        completely from the left camera for 10 frames or more (in scenes of about 40 frames or longer).
    light: the largest difference of the light's gain from 1, 0 or more and below 1; not used by "ramp".
    noise: standard deviation in levels of 255, independent in both images.

    The seed decides the person's size, skin, hair and clothes, the path and the gestures, the room and the
    things in it, the rig (angle of view 50 to 60 degrees, baseline 10 to 12 cm), how much brighter one camera
    is (up to 5 %), and the noise. There is no motion blur, no cast shadow, and no change of expression.
    ValueError or TypeError names the argument that is wrong.
    """
    _check(frames, camera, kind, light, noise)
    rng = make_generator(seed)
    rig = _rig(camera, rng)
    moves = head_moves.sample_walk(frames, _range(rig, kind), kind == "turning", rng)
    gain = _light(kind, frames, light, rng)
    hand = head_moves.sample_hand(frames, rng) if kind == "hidden" else None
    film = _Film(f"head, {kind}, {camera}, seed {seed}", rig, camera, moves, gain, noise)
    changes = tuple((np.flatnonzero(np.diff(gain)) + 1).tolist()) if kind == "jump" else ()
    return film.render(rng, hand, kind == "distractor", changes=changes)


def static_head(
    seed: int = 0,
    frames: int = 60,
    camera: str = "160x120",
    *,
    distance: float = 1.5,
    aside: tuple[float, float] = (0.0, 0.0),
    light: float = 0.0,
    noise: float = 2.0,
) -> StereoScene:
    """As :func:`head`, but the person stands still and looks at the cameras.

    distance: of the head's center along the camera's axis, 0.5 to 10 m; the scene's ``positions``, of its
    surface, are some 7 cm nearer. aside: how far the head is to the right of and below the cameras' midpoint,
    as shares of half the view. ValueError if a camera wouldn't see the whole head.
    light: the largest difference of the light's gain from 1; the light's color then varies by 4 %. At 0
    neither changes.
    """
    _check(frames, camera, "normal", light, noise)
    if not 0.5 <= finite(distance, "distance", "meters") <= 10:
        raise ValueError(f"distance: expected 0.5 to 10 m, got {distance!r}")
    check_pair(aside, "aside", "two shares of half the view")
    rng = make_generator(seed)
    rig = _rig(camera, rng)
    gain = head_moves.sample_smooth_light(frames, light, rng) if light else np.ones(frames)
    view = _range(rig, "normal")
    for share, half, part in zip(aside, (view.side, view.up), (rig.baseline / 2, 0.0), strict=True):
        if abs(finite(share, "aside", "shares of half the view")) * half + (part + RADIUS) / distance > half:
            raise ValueError(f"aside: expected a head in both views at {distance:g} m, got {aside!r}")
    center = np.array([aside[0] * view.side, aside[1] * view.up, 1.0]) * distance
    moves = head_moves.stand(frames, center + [rig.baseline / 2, 0, 0])
    name = f"head at rest, {distance:g} m, {camera}, seed {seed}"
    return _Film(name, rig, camera, moves, gain, noise).render(rng, tinted=light > 0)


class _Film(NamedTuple):
    """What a person does in front of a stereo pair, and the light."""

    name: str
    rig: StereoRig
    camera: str
    moves: HeadMotion
    gain: Array
    noise: float

    def render(
        self,
        rng: np.random.Generator,
        hand: HandMotion | None = None,
        distractors: bool = False,
        *,
        tinted: bool = True,
        changes: tuple[int, ...] = (),
    ) -> StereoScene:
        """Record a random person in a random room. tinted: whether the light's color changes."""
        person = Actor.sample(self.moves, hand, rng)
        skin = person.looks.skin if distractors else None
        room = furnish_room(self.rig, self.moves.center, person.floor, skin, rng)
        stage = _StereoStage.build(RayCamera.pair(self.rig, RAYS_PER_PIXEL[self.camera]), room, rng)
        colors = self.gain[:, None] * (head_moves.sample_tint(len(self.gain), rng) if tinted else np.ones(3))
        truths = [stage.record(person, index, color, self.noise, rng) for index, color in enumerate(colors)]
        return StereoScene(
            name=self.name,
            frames=tuple(truth.frame for truth in truths),
            boxes=tuple(truth.box for truth in truths),
            positions=np.stack([truth.position for truth in truths]),
            visible=np.array([truth.visible for truth in truths]),
            facing=np.array([truth.facing for truth in truths]),
            light=self.gain,
            changes=changes,
            rig=self.rig,
        )


class _VisibleHead(NamedTuple):
    """The head as one camera sees it."""

    part: DrawnEllipsoid
    visible: float  # share of the pixels not behind the neck that no hand hides


class _FrameTruth(NamedTuple):
    """A frame and its truth."""

    frame: Frame
    box: Box
    position: Array
    visible: float
    facing: float


class _StereoStage(NamedTuple):
    """The stereo pair and the room without the person."""

    cameras: tuple[RayCamera, RayCamera]
    empty: tuple[RayImage, RayImage]
    lamp: WhiteLamp
    right_gain: float  # the right camera's gain divided by the left one's

    @classmethod
    def build(
        cls, cameras: tuple[RayCamera, RayCamera], room: StereoRoom, rng: np.random.Generator
    ) -> "_StereoStage":
        direction = rng.uniform([-0.8, -1.0, -1.0], [0.8, -0.4, -0.5])
        lamp = WhiteLamp(direction / np.linalg.norm(direction), rng.uniform(0.45, 0.65))
        empty = tuple(render_room(camera, room, lamp) for camera in cameras)
        return cls(cameras, (empty[0], empty[1]), lamp, rng.uniform(0.95, 1.05))

    def record(
        self, actor: Actor, index: int, color: Array, noise: float, rng: np.random.Generator
    ) -> _FrameTruth:
        """The stereo pair of a frame. color: (3,) gain of each channel."""
        pose = actor.pose_at(index)
        (left, seen), (right, _) = (
            self._draw(pose, camera, empty) for camera, empty in zip(self.cameras, self.empty, strict=True)
        )
        images = [
            expose_lit(camera.average_rays(canvas), color * gain, noise, rng)
            for camera, canvas, gain in zip(self.cameras, (left, right), (1.0, self.right_gain), strict=True)
        ]
        frame = Frame(images[0], right=images[1], timestamp=index / head_moves.HEAD_FRAME_RATE)
        return _FrameTruth(frame, self._box(pose.head), self._position(seen.part), seen.visible, pose.facing)

    def _draw(self, pose: PosedActor, camera: RayCamera, empty: RayImage) -> tuple[RayImage, _VisibleHead]:
        canvas = empty.copy()
        part, *_ = camera.draw_ellipsoids(canvas, [pose.head, *pose.body], self.lamp)
        assert part is not None  # the paths keep the head in both images
        own = canvas.depth[part.place] == part.depth
        camera.draw_ellipsoids(canvas, pose.hand, self.lamp)
        left = own & (canvas.depth[part.place] == part.depth)
        return canvas, _VisibleHead(part, float(left.sum() / own.sum()))

    def _position(self, part: DrawnEllipsoid) -> Array:
        """The mean (3,) of the surface points that the left camera's rays hit, meters."""
        (rows, columns), depth = part
        v, u = np.nonzero(np.isfinite(depth))
        points = self.cameras[0].intrinsics.back_project(u + columns.start, v + rows.start, depth[v, u])
        return np.asarray(points.mean(axis=0))

    def _box(self, head: TexturedEllipsoid) -> Box:
        """The box of the head's outline in the left image; the camera's grid has several rays per pixel."""
        camera = self.cameras[0]
        shape = np.linalg.inv(head.unit.T @ head.unit)
        sides = MountedCamera(camera.intrinsics, 0.0, 0.0).ellipsoid_boxes(
            Ellipsoids(head.center[None], shape[None])
        )[0]
        return Box.from_xyxy(*(sides / camera.rays).tolist())


def _rig(camera: str, rng: np.random.Generator) -> StereoRig:
    width, height = map(int, camera.split("x"))
    angle, baseline = rng.uniform([50, 0.10], [60, 0.12])
    return StereoRig(Intrinsics.from_fov(width, height, angle), baseline)


def _range(rig: StereoRig, kind: str) -> HeadRange:
    camera = rig.intrinsics
    near, far = HIDDEN_HEAD_DISTANCES if kind == "hidden" else (MIN_HEAD_DISTANCE, MAX_HEAD_DISTANCE)
    return HeadRange(near, far, camera.width / 2 / camera.fx, camera.height / 2 / camera.fy, rig.baseline)


def _light(kind: str, frames: int, reach: float, rng: np.random.Generator) -> Array:
    if kind == "ramp":
        return head_moves.make_ramp_light(frames)
    change = head_moves.sample_jumping_light if kind == "jump" else head_moves.sample_smooth_light
    return change(frames, reach, rng)


def _check(frames: int, camera: str, kind: str, light: float, noise: float) -> None:
    positive_whole(frames, "frames", "a count")
    for value, name, known in ((camera, "camera", tuple(RAYS_PER_PIXEL)), (kind, "kind", HEAD_KINDS)):
        if value not in known:
            raise ValueError(f"{name}: expected one of {', '.join(known)}, got {value!r}")
    if not 0 <= finite(light, "light", "a share") < 1:
        raise ValueError(f"light: expected a share of 0 or more and below 1, got {light!r}")
    if finite(noise, "noise", "levels of 255") < 0:
        raise ValueError(f"noise: expected levels of 255, 0 or more, got {noise!r}")
