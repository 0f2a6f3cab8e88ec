# SPDX-License-Identifier: MIT
"""The stage of a scene with everything: all that is drawn, and each frame's truth."""

from typing import NamedTuple

import cv2
import numpy as np

from tricue.camera.rig import Intrinsics, StereoRig
from tricue.scenes.arrays import Array, Mask
from tricue.scenes.stress.appearance import (
    WALL_PHOTOGRAPHS,
    StressRoom,
    choose_other,
    furnish_stress_room,
    make_cards,
)
from tricue.scenes.stress.cards import CardCamera, CardImage
from tricue.scenes.stress.events import CardPath, StressMotion
from tricue.scenes.stress.plan import plan_motion

FIELD_OF_VIEW, STRESS_BASELINE = 60.0, 0.12  # degrees across, metres
TARGET_SIZE = 0.24  # of the target, about, at its middle depth, as a share of the image's height
MEDIAN_TARGET_DEPTH = 1.8  # metres
TARGET_LABEL, LOOKALIKE_LABELS, OCCLUDER = 1, (2, 3), 4  # names on a canvas


class StressTruth(NamedTuple):
    """A frame's truth, and the left camera's canvas."""

    canvas: CardImage
    boxes: tuple[Array, Array, Array]  # (4,) of the target and the look-alikes
    visible: float
    position: Array
    mask: Mask


class StressStage(NamedTuple):
    """All that is to be drawn."""

    moves: StressMotion
    rooms: tuple[StressRoom, StressRoom]  # the target's, and another
    rig: StereoRig
    straight: dict[
        tuple[float, bool], CardImage
    ]  # the rooms before a camera that looks straight, by its offset

    @classmethod
    def build(cls, kind: str, seed: int, size: tuple[int, int]) -> "StressStage":
        camera = Intrinsics.from_fov(*size, FIELD_OF_VIEW)
        rng = np.random.default_rng([seed, 0])
        wall = choose_other(WALL_PHOTOGRAPHS, (), rng)
        cards = make_cards(TARGET_SIZE * size[1] / camera.fx * MEDIAN_TARGET_DEPTH, wall, rng)
        room = furnish_stress_room(camera, wall, rng)
        in_other_room = furnish_stress_room(
            camera, choose_other(WALL_PHOTOGRAPHS, (wall, cards.source), rng), rng
        )
        moves = plan_motion(kind, camera, cards, MEDIAN_TARGET_DEPTH, np.random.default_rng([seed, 1]))
        return cls(moves, (room, in_other_room), StereoRig(camera, STRESS_BASELINE), {})

    def draw(self, eye: CardCamera, index: int, time: float) -> CardImage:
        """What an eye sees at a time within a frame, in the light of 1."""
        moves = self.moves
        in_other_room = bool(moves.in_other_room[index])
        canvas = self._empty(eye, in_other_room, time)
        if not in_other_room:
            paths = zip(
                (TARGET_LABEL, *LOOKALIKE_LABELS, OCCLUDER),
                (moves.target, *moves.lookalikes, moves.occluder),
                strict=True,
            )
            there = [(label, path) for label, path in paths if path.present[index]]
            for label, path in sorted(there, key=lambda named: -named[1].depth[index]):
                eye.draw(canvas, path.card, path.pose(eye.camera, time), label)
        return canvas

    def _empty(self, eye: CardCamera, in_other_room: bool, time: float) -> CardImage:
        """A room alone; drawn once where the camera looks straight, as it mostly does."""
        rotation, key = self.moves.rotation(time), (eye.offset, in_other_room)
        straight = bool((rotation == np.eye(3)).all())
        if straight and key in self.straight:
            return self.straight[key].copy()
        canvas = CardImage.empty(eye.camera)
        self.rooms[in_other_room].draw(eye, canvas, rotation)
        if straight:
            self.straight[key] = canvas.copy()
        return canvas

    def truth_at(self, index: int) -> StressTruth:
        """The truth of a frame."""
        moves, eye = self.moves, CardCamera(self.moves.camera)
        canvas = self.draw(eye, index, index)
        boxes = [self._box(path, index) for path in (moves.target, *moves.lookalikes)]
        unseen = moves.black[index] or np.isnan(boxes[0]).any()
        mask = (canvas.labels == TARGET_LABEL) & (not unseen)
        pose = moves.target.pose(eye.camera, index)
        visible = 0.0 if unseen else float(mask.sum()) / self._whole(index)
        position = np.full(3, np.nan) if np.isnan(boxes[0]).any() else pose.center
        return StressTruth(canvas, (boxes[0], boxes[1], boxes[2]), visible, position, mask)

    def _box(self, path: CardPath, index: int) -> Array:
        """The box of a card in a frame, NaN where it isn't in the picture."""
        eye = CardCamera(self.moves.camera)
        pose = path.pose(eye.camera, index)
        if not path.present[index] or self.moves.in_other_room[index] or not eye.mask(path.card, pose).any():
            return np.full(4, np.nan)
        outline = eye.outline(path.card, pose)
        return np.concatenate([outline.min(axis=0), np.ptp(outline, axis=0)])

    def _whole(self, index: int) -> float:
        """How many pixels the target has where nothing hides it, those beyond the image's edge included."""
        eye, target = CardCamera(self.moves.camera), self.moves.target
        pose = target.pose(eye.camera, index)
        count = float(eye.mask(target.card, pose).sum())
        outline = eye.outline(target.card, pose)
        inside = (outline >= 0).all() and (outline <= [eye.camera.width, eye.camera.height]).all()
        return count if inside else max(count, float(cv2.contourArea(outline.astype(np.float32))))
