# SPDX-License-Identifier: MIT
"""A head before a stereo pair: as in Moreno, Tarrida, Andrade-Cetto and Sanfeliu (2002), section 5."""

from typing import NamedTuple

import numpy as np

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.numbers import finite, positive_whole
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.scenes.arrays import Array
from tricue.scenes.heads import moves as head_moves
from tricue.scenes.heads import room as rooms
from tricue.scenes.heads.actor import Actor, Moment
from tricue.scenes.heads.moves import Range
from tricue.scenes.rendering.depth_view import View
from tricue.scenes.rendering.ellipsoids import Ellipsoids
from tricue.scenes.rendering.stereo_camera import Canvas, Eye, Lamp, Part, Solid, photograph
from tricue.scenes.scene import StereoScene

KINDS = ("normal", "distractor", "turning", "jump", "ramp", "hidden")
CAMERAS = {"160x120": 3, "640x480": 2}  # rays a pixel along each axis
NEAREST, FARTHEST = 0.9, 4.05  # metres, of the head's centre
REACH = 1.0, 2.1  # the same where somebody's hand has to be nearer


def head(
    seed: int = 0,
    frames: int = 100,
    camera: str = "160x120",
    *,
    kind: str = "normal",
    light: float = 0.3,
    noise: float = 2.0,
) -> StereoScene:
    """Somebody walks about before a stereo pair, 0.8 to 4 m away, in a cluttered room; 30 frames/s.

    camera: "160x120" or "640x480" pixels. kind: one of KINDS;
        "normal": the face stays in sight, the light swings smoothly;
        "distractor": as that, and the head passes in front of things of its skin's color;
        "turning": as that, and the person turns round, so that only hair is seen for a while;
        "jump": the light changes abruptly every 10 to 20 frames, instead of smoothly;
        "ramp": the light falls evenly from 1 to 0.5 within 100 frames;
        "hidden": as "normal", and a hand nearer than the head, which is then at 1 to 2.1 m, hides it
        completely from the left camera for 10 frames or more (in scenes of about 40 frames or longer).
    light: the share by which the light rises and falls round 1, below 1; not used by "ramp".
    noise: standard deviation in levels of 255, independent in both images.

    The seed decides the person's size, skin, hair and clothes, the path and the gestures, the room and the
    things in it, the rig (angle of view 50 to 60 degrees, baseline 10 to 12 cm), how much brighter one camera
    is (up to 5 %), and the noise. There is no motion blur and no shadow cast, and the face doesn't change.
    """
    _check(frames, camera, kind, light, noise)
    rng = np.random.default_rng(seed)
    rig = _rig(camera, rng)
    moves = head_moves.walk(frames, _range(rig, kind), kind == "turning", rng)
    gain = _light(kind, frames, light, rng)
    person = Actor.draw(moves, head_moves.cover(frames, rng) if kind == "hidden" else None, rng)
    skin = person.looks.skin if kind == "distractor" else None
    room = rooms.furnish(rig, moves.center, person.floor, skin, rng)
    stage = _Stage.build(Eye.pair(rig, CAMERAS[camera]), room, rng)
    colors = gain[:, None] * head_moves.tint(frames, rng)
    shots = [stage.shoot(person, index, color, noise, rng) for index, color in enumerate(colors)]
    return StereoScene(
        name=f"head, {kind}, {camera}, seed {seed}",
        frames=tuple(shot.frame for shot in shots),
        boxes=tuple(shot.box for shot in shots),
        positions=np.stack([shot.position for shot in shots]),
        visible=np.array([shot.visible for shot in shots]),
        facing=np.array([shot.facing for shot in shots]),
        light=gain,
        changes=tuple((np.flatnonzero(np.diff(gain)) + 1).tolist()) if kind == "jump" else (),
        rig=rig,
    )


class _Sight(NamedTuple):
    """The head as one camera sees it."""

    part: Part
    visible: float  # share of its pixels, beside those that the neck takes, that no hand hides


class _Shot(NamedTuple):
    """One frame and its truth."""

    frame: Frame
    box: Box
    position: Array
    visible: float
    facing: float


class _Stage(NamedTuple):
    """The pair before an empty room."""

    eyes: tuple[Eye, Eye]
    empty: tuple[Canvas, Canvas]
    lamp: Lamp
    unequal: float  # the right camera's gain over the left one's

    @classmethod
    def build(cls, eyes: tuple[Eye, Eye], room: rooms.Room, rng: np.random.Generator) -> "_Stage":
        direction = rng.uniform([-0.8, -1.0, -1.0], [0.8, -0.4, -0.5])
        lamp = Lamp(direction / np.linalg.norm(direction), rng.uniform(0.45, 0.65))
        empty = tuple(rooms.draw(eye, room, lamp) for eye in eyes)
        return cls(eyes, (empty[0], empty[1]), lamp, rng.uniform(0.95, 1.05))

    def shoot(self, actor: Actor, index: int, color: Array, noise: float, rng: np.random.Generator) -> _Shot:
        pose = actor.moment(index)
        (left, sight), (right, _) = (
            self._draw(pose, eye, empty) for eye, empty in zip(self.eyes, self.empty, strict=True)
        )
        images = [
            photograph(eye.develop(canvas), color * camera, noise, rng)
            for eye, canvas, camera in zip(self.eyes, (left, right), (1.0, self.unequal), strict=True)
        ]
        frame = Frame(images[0], right=images[1], timestamp=index / head_moves.RATE)
        return _Shot(frame, self._box(pose.head), self._position(sight.part), sight.visible, pose.facing)

    def _draw(self, pose: Moment, eye: Eye, empty: Canvas) -> tuple[Canvas, _Sight]:
        canvas = empty.copy()
        part, *_ = eye.draw_solids(canvas, [pose.head, *pose.body], self.lamp)
        assert part is not None  # the paths keep the head in both images
        own = canvas.depth[part.place] == part.depth
        eye.draw_solids(canvas, pose.hand, self.lamp)
        left = own & (canvas.depth[part.place] == part.depth)
        return canvas, _Sight(part, float(left.sum() / own.sum()))

    def _position(self, part: Part) -> Array:
        """The mean of the surface points that the left camera's rays hit."""
        (rows, columns), depth = part
        v, u = np.nonzero(np.isfinite(depth))
        points = self.eyes[0].intrinsics.back_project(u + columns.start, v + rows.start, depth[v, u])
        return np.asarray(points.mean(axis=0))

    def _box(self, head_: Solid) -> Box:
        """Round the head's outline in pixels of the left image, from that in the grid of rays."""
        eye = self.eyes[0]
        shape = np.linalg.inv(head_.unit.T @ head_.unit)
        sides = View(eye.intrinsics, 0.0, 0.0).outline(Ellipsoids(head_.center[None], shape[None]))[0]
        return Box.from_xyxy(*(sides / eye.rays).tolist())


def _rig(camera: str, rng: np.random.Generator) -> StereoRig:
    width, height = map(int, camera.split("x"))
    angle, baseline = rng.uniform([50, 0.10], [60, 0.12])
    return StereoRig(Intrinsics.from_fov(width, height, angle), baseline)


def _range(rig: StereoRig, kind: str) -> Range:
    camera = rig.intrinsics
    near, far = REACH if kind == "hidden" else (NEAREST, FARTHEST)
    return Range(near, far, camera.width / 2 / camera.fx, camera.height / 2 / camera.fy, rig.baseline)


def _light(kind: str, frames: int, reach: float, rng: np.random.Generator) -> Array:
    if kind == "ramp":
        return head_moves.ramp_light(frames)
    change = head_moves.jumping_light if kind == "jump" else head_moves.smooth_light
    return change(frames, reach, rng)


def _check(frames: int, camera: str, kind: str, light: float, noise: float) -> None:
    positive_whole(frames, "frames", "a count")
    for value, name, known in ((camera, "camera", tuple(CAMERAS)), (kind, "kind", KINDS)):
        if value not in known:
            raise ValueError(f"{name}: expected one of {', '.join(known)}, got {value!r}")
    if not 0 <= finite(light, "light", "a share") < 1:
        raise ValueError(f"light: expected a share of 0 or more and below 1, got {light!r}")
    if finite(noise, "noise", "levels of 255") < 0:
        raise ValueError(f"noise: expected levels of 255, 0 or more, got {noise!r}")
