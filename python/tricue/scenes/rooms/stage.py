# SPDX-License-Identifier: MIT
"""The stage of a room: draws its frames and computes the truth of each."""

from dataclasses import dataclass, field

import numpy as np

from tricue.camera.rig import StereoRig
from tricue.scenes.arrays import Array, Mask, Picture
from tricue.scenes.rendering.stereo_camera import RayCamera, RayImage
from tricue.scenes.rooms.plan import RoomPlan
from tricue.scenes.rooms.solids import Placement, Solid

BACKGROUND = 90.0  # gray level beyond the room


@dataclass
class RoomView:
    """What one ray in the middle of each pixel hits: depth (H, W) in meters, the target, shiny things."""

    depth: Array
    target: Mask
    shiny: Mask


@dataclass
class RoomTruth:
    """The truth of a frame; NaN if the target is outside the image."""

    view: RoomView
    box: Array  # (4,)
    position: Array  # (3,)
    visible: float


@dataclass
class RoomStage:
    """A plan, seen by a stereo rig whose left camera is the color camera."""

    plan: RoomPlan
    rig: StereoRig
    rays: int
    _pictures: dict[float, tuple[Placement, RayImage]] = field(default_factory=dict)
    _views: list[tuple[Placement, RayImage, Mask]] = field(default_factory=list)

    def picture(self, index: int, right: bool = False) -> Picture:
        """The color image (H, W, 3) of a frame for the left or the right camera, before noise."""
        camera, pose = RayCamera.pair(self.rig, self.rays)[right], self.plan.cameras[index]
        cached = self._pictures.get(camera.offset)
        if cached is None or cached[0] is not pose:
            canvas = _empty(camera)
            for thing in self.plan.still:
                self._draw(camera, canvas, thing.solid, pose)
            cached = self._pictures[camera.offset] = pose, canvas
        canvas = cached[1].copy()
        for solid in (self.plan.target[index], *(mover[index] for mover in self.plan.movers)):
            self._draw(camera, canvas, solid, pose)
        return camera.average_rays(canvas)

    def truth_at(self, index: int) -> RoomTruth:
        """The truth of a frame."""
        camera, pose, target = self._probe, self.plan.cameras[index], self.plan.target[index]
        canvas, shiny = self._still_view(pose)
        before = canvas.depth.copy()
        self._draw(camera, canvas, target, pose)
        mask = np.asarray(canvas.depth != before)
        shiny = np.where(mask, self.plan.shiny, shiny)
        for mover in self.plan.movers:
            before = canvas.depth.copy()
            self._draw(camera, canvas, mover[index], pose)
            covered = canvas.depth != before
            mask &= ~covered
            shiny &= ~covered
        alone = _empty(camera)
        self._draw(camera, alone, target, pose)
        return _truth(
            RoomView(canvas.depth.astype(np.float64), mask, shiny), alone.depth, target.placed(pose), self.rig
        )

    def _still_view(self, pose: Placement) -> tuple[RayImage, Mask]:
        """A copy of the image of the static things, and its shiny pixels."""
        if not self._views or self._views[0][0] is not pose:
            canvas = _empty(self._probe)
            shiny = np.zeros(canvas.depth.shape, bool)
            for thing in self.plan.still:
                before = canvas.depth.copy()
                self._draw(self._probe, canvas, thing.solid, pose)
                shiny[canvas.depth != before] = thing.shiny
            self._views = [(pose, canvas, shiny)]
        _, canvas, shiny = self._views[0]
        return canvas.copy(), shiny.copy()

    @property
    def _probe(self) -> RayCamera:
        return RayCamera(self.rig.intrinsics, 0.0, 1)

    def _draw(self, camera: RayCamera, canvas: RayImage, solid: Solid, pose: Placement) -> None:
        lamp = self.plan.lamp
        solid.placed(pose).draw(camera, canvas, lamp._replace(direction=pose.rotation @ lamp.direction))


def _truth(view: RoomView, alone: Picture, target: Solid, rig: StereoRig) -> RoomTruth:
    camera = rig.intrinsics
    rows, columns = np.nonzero(np.isfinite(alone))
    box = target.box(camera)
    if not len(rows) or np.isnan(box).any():
        return RoomTruth(view, np.full(4, np.nan), np.full(3, np.nan), 0.0)
    position = camera.back_project(columns, rows, alone[rows, columns]).mean(axis=0)
    low = np.maximum(box[:2], 0)
    inside = (np.minimum(box[:2] + box[2:], [camera.width, camera.height]) - low).clip(0)
    seen_part = float(np.prod(inside) / np.prod(box[2:]))
    return RoomTruth(view, box, position, float(view.target.sum()) / len(rows) * min(seen_part, 1.0))


def _empty(camera: RayCamera) -> RayImage:
    shape = camera.intrinsics.height, camera.intrinsics.width
    return RayImage(np.full((*shape, 3), BACKGROUND, np.float32), np.full(shape, np.inf, np.float32))
