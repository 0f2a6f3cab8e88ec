# SPDX-License-Identifier: MIT
"""The stage of a scene with everything: all that is drawn, and each frame's truth."""

from typing import NamedTuple

import cv2
import numpy as np

from tricue.camera.rig import Intrinsics, StereoRig
from tricue.scenes.arrays import Array, Mask
from tricue.scenes.stress.cards import Canvas, Eye
from tricue.scenes.stress.looks import WALLS, Room, cast, furnish, other
from tricue.scenes.stress.moves import Moves, Way
from tricue.scenes.stress.plan import lay

FIELD, BASELINE = 60.0, 0.12  # degrees across, metres
SIDE = 0.24  # of the target, about, at its middle depth, as a share of the image's height
MIDDLE = 1.8  # metres
TARGET, LOOKALIKES, CURTAIN = 1, (2, 3), 4  # names on a canvas


class Sight(NamedTuple):
    """A frame's truth, and the left camera's canvas."""

    canvas: Canvas
    boxes: tuple[Array, Array, Array]  # (4,) of the target and the look-alikes
    visible: float
    position: Array
    mask: Mask


class Stage(NamedTuple):
    """All that is to be drawn."""

    moves: Moves
    rooms: tuple[Room, Room]  # the target's, and another
    rig: StereoRig
    straight: dict[tuple[float, bool], Canvas]  # the rooms before a camera that looks straight, by its offset

    @classmethod
    def build(cls, kind: str, seed: int, size: tuple[int, int]) -> "Stage":
        camera = Intrinsics.from_fov(*size, FIELD)
        rng = np.random.default_rng([seed, 0])
        wall = other(WALLS, (), rng)
        everybody = cast(SIDE * size[1] / camera.fx * MIDDLE, wall, rng)
        room = furnish(camera, wall, rng)
        elsewhere = furnish(camera, other(WALLS, (wall, everybody.source), rng), rng)
        moves = lay(kind, camera, everybody, MIDDLE, np.random.default_rng([seed, 1]))
        return cls(moves, (room, elsewhere), StereoRig(camera, BASELINE), {})

    def draw(self, eye: Eye, index: int, time: float) -> Canvas:
        """What an eye sees at a time within a frame, in the light of 1."""
        moves = self.moves
        elsewhere = bool(moves.elsewhere[index])
        canvas = self._empty(eye, elsewhere, time)
        if not elsewhere:
            ways = zip(
                (TARGET, *LOOKALIKES, CURTAIN), (moves.target, *moves.lookalikes, moves.curtain), strict=True
            )
            there = [(name, way) for name, way in ways if way.there[index]]
            for name, way in sorted(there, key=lambda named: -named[1].depth[index]):
                eye.draw(canvas, way.card, way.pose(eye.camera, time), name)
        return canvas

    def _empty(self, eye: Eye, elsewhere: bool, time: float) -> Canvas:
        """A room alone; drawn once where the camera looks straight, as it mostly does."""
        rotation, key = self.moves.rotation(time), (eye.offset, elsewhere)
        straight = bool((rotation == np.eye(3)).all())
        if straight and key in self.straight:
            return self.straight[key].copy()
        canvas = Canvas.empty(eye.camera)
        self.rooms[elsewhere].draw(eye, canvas, rotation)
        if straight:
            self.straight[key] = canvas.copy()
        return canvas

    def sight(self, index: int) -> Sight:
        """The truth of a frame."""
        moves, eye = self.moves, Eye(self.moves.camera)
        canvas = self.draw(eye, index, index)
        boxes = [self._box(way, index) for way in (moves.target, *moves.lookalikes)]
        unseen = moves.black[index] or np.isnan(boxes[0]).any()
        mask = (canvas.names == TARGET) & (not unseen)
        pose = moves.target.pose(eye.camera, index)
        visible = 0.0 if unseen else float(mask.sum()) / self._whole(index)
        position = np.full(3, np.nan) if np.isnan(boxes[0]).any() else pose.center
        return Sight(canvas, (boxes[0], boxes[1], boxes[2]), visible, position, mask)

    def _box(self, way: Way, index: int) -> Array:
        """The box of a card in a frame, NaN where it isn't in the picture."""
        eye = Eye(self.moves.camera)
        pose = way.pose(eye.camera, index)
        if not way.there[index] or self.moves.elsewhere[index] or not eye.mask(way.card, pose).any():
            return np.full(4, np.nan)
        outline = eye.outline(way.card, pose)
        return np.concatenate([outline.min(axis=0), np.ptp(outline, axis=0)])

    def _whole(self, index: int) -> float:
        """How many pixels the target has where nothing hides it, those beyond the image's edge included."""
        eye, target = Eye(self.moves.camera), self.moves.target
        pose = target.pose(eye.camera, index)
        count = float(eye.mask(target.card, pose).sum())
        outline = eye.outline(target.card, pose)
        inside = (outline >= 0).all() and (outline <= [eye.camera.width, eye.camera.height]).all()
        return count if inside else max(count, float(cv2.contourArea(outline.astype(np.float32))))
