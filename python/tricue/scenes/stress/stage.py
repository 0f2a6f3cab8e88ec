# SPDX-License-Identifier: MIT
"""The stage of a stress scene: everything that is drawn, and the truth of each frame."""

from typing import NamedTuple

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

FIELD_OF_VIEW, STRESS_BASELINE = 60.0, 0.12  # horizontal, degrees; meters
TARGET_SIZE = 0.24  # of the target at its mean depth, as a share of the image's height, approximately
MEAN_TARGET_DEPTH = 1.8  # meters
TARGET_LABEL, LOOKALIKE_LABELS, OCCLUDER_LABEL = 1, (2, 3), 4  # in a canvas


class StressTruth(NamedTuple):
    """The truth of a frame, and the left camera's canvas."""

    canvas: CardImage
    boxes: tuple[Array, Array, Array]  # (4,) of the target and the look-alikes
    visible: float
    position: Array
    mask: Mask


class StressStage(NamedTuple):
    """Everything that is drawn: the moving cards, the rooms, and the cameras."""

    motion: StressMotion
    rooms: tuple[StressRoom, StressRoom]  # the target's room, and the other one
    rig: StereoRig
    straight: dict[tuple[float, bool], CardImage]  # cached room images of a camera that looks straight ahead

    @classmethod
    def build(cls, kind: str, seed: int, size: tuple[int, int], away: int | None = None) -> "StressStage":
        camera = Intrinsics.from_fov(*size, FIELD_OF_VIEW)
        rng = np.random.default_rng([seed, 0])
        wall = choose_other(WALL_PHOTOGRAPHS, (), rng)
        cards = make_cards(TARGET_SIZE * size[1] / camera.fx * MEAN_TARGET_DEPTH, wall, rng)
        room = furnish_stress_room(camera, wall, rng)
        other_room = furnish_stress_room(
            camera, choose_other(WALL_PHOTOGRAPHS, (wall, cards.photograph), rng), rng
        )
        rng = np.random.default_rng([seed, 1])
        motion = plan_motion(kind, away, camera, cards, MEAN_TARGET_DEPTH, rng)
        return cls(motion, (room, other_room), StereoRig(camera, STRESS_BASELINE), {})

    def draw(self, camera: CardCamera, index: int, time: float) -> CardImage:
        """Render a frame for a camera, at a time within it, under light of gain 1."""
        motion = self.motion
        in_other_room = bool(motion.in_other_room[index])
        canvas = self._draw_room(camera, in_other_room, time)
        if not in_other_room:
            paths = zip(
                (TARGET_LABEL, *LOOKALIKE_LABELS, OCCLUDER_LABEL),
                (motion.target, *motion.lookalikes, motion.occluder),
                strict=True,
            )
            present = [(label, path) for label, path in paths if path.present[index]]
            for label, path in sorted(present, key=lambda named: -named[1].depth[index]):
                camera.draw(canvas, path.card, path.pose(camera.intrinsics, time), label)
        return canvas

    def _draw_room(self, camera: CardCamera, in_other_room: bool, time: float) -> CardImage:
        """The room without moving cards; it is cached where the camera looks straight ahead."""
        rotation, key = self.motion.rotation(time), (camera.offset, in_other_room)
        straight = bool((rotation == np.eye(3)).all())
        if straight and key in self.straight:
            return self.straight[key].copy()
        canvas = CardImage.empty(camera.intrinsics)
        self.rooms[in_other_room].draw(camera, canvas, rotation)
        if straight:
            self.straight[key] = canvas.copy()
        return canvas

    def truth_at(self, index: int) -> StressTruth:
        """The truth of a frame."""
        motion, camera = self.motion, CardCamera(self.motion.camera)
        canvas = self.draw(camera, index, index)
        boxes = [self._box(path, index) for path in (motion.target, *motion.lookalikes)]
        unseen = motion.black[index] or np.isnan(boxes[0]).any()
        mask = (canvas.labels == TARGET_LABEL) & (not unseen)
        pose = motion.target.pose(camera.intrinsics, index)
        visible = 0.0 if unseen else float(mask.sum()) / self._count_pixels(index)
        position = np.full(3, np.nan) if np.isnan(boxes[0]).any() else pose.center
        return StressTruth(canvas, (boxes[0], boxes[1], boxes[2]), visible, position, mask)

    def _box(self, path: CardPath, index: int) -> Array:
        """The box (4,) of a card in a frame, NaN where it isn't in the image."""
        camera = CardCamera(self.motion.camera)
        pose = path.pose(camera.intrinsics, index)
        if (
            not path.present[index]
            or self.motion.in_other_room[index]
            or not camera.mask(path.card, pose).any()
        ):
            return np.full(4, np.nan)
        outline = camera.outline(path.card, pose)
        return np.concatenate([outline.min(axis=0), np.ptp(outline, axis=0)])

    def _count_pixels(self, index: int) -> float:
        """The target's number of pixels if nothing hid it, including those beyond the image."""
        camera, target = CardCamera(self.motion.camera), self.motion.target
        pose = target.pose(camera.intrinsics, index)
        count = float(camera.mask(target.card, pose).sum())
        outline = camera.outline(target.card, pose)
        inside = (outline >= 0).all() and (
            outline <= [camera.intrinsics.width, camera.intrinsics.height]
        ).all()
        return count if inside else max(count, _area(outline))


def _area(outline: Array) -> float:
    """The area of a polygon (n, 2), by the shoelace formula."""
    x, y = outline.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2
