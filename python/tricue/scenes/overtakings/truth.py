# SPDX-License-Identifier: MIT
"""The truth at each pixel of a walking scene: visibility, depth, disparity and flow."""

from collections.abc import Callable, Iterator, Sequence
from typing import Generic, NamedTuple, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.scenes.arrays import Array, Mask
from tricue.scenes.overtakings.hall import Hall
from tricue.scenes.overtakings.pan import Pan
from tricue.scenes.people.pedestrian import Pedestrian
from tricue.scenes.rendering import zbuffer
from tricue.scenes.rendering.depth_view import MountedCamera
from tricue.scenes.rendering.ellipsoids import Ellipsoids, OrientedEllipsoids
from tricue.scenes.rendering.stereo_camera import RayCamera
from tricue.scenes.scene import Bystander

T = TypeVar("T")


class LazySequence(Sequence[T], Generic[T]):
    """A sequence whose items are computed on access, and not kept."""

    def __init__(self, count: int, make: Callable[[int], T]) -> None:
        self._count, self._make = count, make

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> T: ...
    @overload
    def __getitem__(self, index: slice) -> "LazySequence[T]": ...
    def __getitem__(self, index: int | slice) -> "T | LazySequence[T]":
        chosen = range(self._count)[index]
        if isinstance(chosen, range):
            return LazySequence(len(chosen), lambda i: self._make(chosen[i]))
        return self._make(chosen)

    def __iter__(self) -> Iterator[T]:
        return map(self._make, range(self._count))


class FrameTruth(NamedTuple):
    """The people in one frame, in the left camera's image and frame."""

    target: Bystander
    others: tuple[Bystander, ...]
    mask: Mask  # (H, W), the target's visible pixels
    visible_box: Box | None  # of the mask
    visible: float  # share of the target's pixels that are in the mask


class WalkGeometry(NamedTuple):
    """The geometry of all frames; the first pedestrian is the target."""

    pan: Pan
    hall: Hall
    people: list[Pedestrian]

    def truth_at(self, index: int) -> FrameTruth:
        """Where the people are in a frame, and which pixels of the target are visible."""
        bodies = [self._parts(index, person).ellipsoids for person in self.people]
        windows = [self._view.render(body) for body in bodies]
        target, *others = (
            Bystander(self._view.bounding_box(body), self._view.surface_points(window).mean(axis=0))
            for body, window in zip(bodies, windows, strict=True)
        )
        nearest = np.full(self._shape, np.inf)
        for window in windows:
            zbuffer.merge_window(window, nearest)
        mask, visible = zbuffer.find_visible_pixels(windows[0], nearest)
        return FrameTruth(target, tuple(others), mask, zbuffer.box_of_mask(mask), visible)

    def depth(self, index: int) -> Array:
        """The depth z (H, W) at each pixel's center, meters."""
        return self._render(index)[0]

    def disparity(self, index: int) -> NDArray[np.float32]:
        """The disparity (H, W) of the left image, pixels."""
        rig = self.pan.rig
        return (rig.intrinsics.fx * rig.baseline / self.depth(index)).astype(np.float32)

    def flow(self, index: int) -> NDArray[np.float32]:
        """The motion (H, W, 2), pixels along x and y, since the last frame, of the surface at each pixel."""
        if index == 0:
            return np.full((*self._shape, 2), np.nan, np.float32)
        depth, owner = self._render(index)
        now, before = self.pan.to_camera(index), self.pan.to_camera(index - 1)
        moves = [np.column_stack([before @ now.T, np.zeros(3)])]
        for person in self.people:
            earlier_parts, parts = self._parts(index - 1, person), self._parts(index, person)
            rotation = earlier_parts.roots @ np.linalg.inv(parts.roots)
            offset = earlier_parts.centers[:, :, None] - rotation @ parts.centers[:, :, None]
            moves += list(np.concatenate([rotation, offset], axis=2))
        v, u = np.indices(self._shape)
        points = self.pan.rig.intrinsics.back_project(u, v, depth)
        move = np.stack(moves)[owner]
        earlier = (move[..., :3] @ points[..., None])[..., 0] + move[..., 3]
        return (np.stack([u, v], axis=-1) - self.pan.rig.intrinsics.project(earlier)).astype(np.float32)

    def _render(self, index: int) -> tuple[Array, NDArray[np.intp]]:
        """The depth (H, W), and what each pixel shows: 0 for the hall, then all people's parts in order."""
        camera = RayCamera(self.pan.rig.intrinsics, 0.0, 1)
        depth = self.hall.render(camera, self.pan.to_camera(index)).depth.astype(np.float64)
        owner = np.zeros(self._shape, np.intp)
        number = 0
        for person in self.people:
            for part in zip(*self._parts(index, person).ellipsoids, strict=True):
                number += 1
                window = self._view.render(Ellipsoids(*(array[None] for array in part)))
                place, disparity_ratio = zbuffer.merge_window(window, depth)
                owner[place][disparity_ratio] = number
        return depth, owner

    def _parts(self, index: int, person: Pedestrian) -> OrientedEllipsoids:
        return person.parts[index].transformed(self.pan.to_camera(index), np.zeros(3))

    @property
    def _view(self) -> MountedCamera:
        return MountedCamera(self.pan.rig.intrinsics, self.pan.height, 0.0)

    @property
    def _shape(self) -> tuple[int, int]:
        return self.pan.rig.intrinsics.height, self.pan.rig.intrinsics.width
