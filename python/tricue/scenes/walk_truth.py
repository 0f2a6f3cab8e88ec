# SPDX-License-Identifier: MIT
"""The truth about each pixel of a scene with walkers: who is there, how far, and where it was before."""

from collections.abc import Callable, Iterator, Sequence
from typing import Generic, NamedTuple, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.scenes.body import Array, Balls, Ellipsoids
from tricue.scenes.depth_camera import Mask, View
from tricue.scenes.halls import Hall
from tricue.scenes.pan import Pan
from tricue.scenes.pedestrians import Pedestrian
from tricue.scenes.stereo_camera import Eye

T = TypeVar("T")


class Lazy(Sequence[T], Generic[T]):
    """A sequence whose items are made when they are asked for, and not kept."""

    def __init__(self, count: int, make: Callable[[int], T]) -> None:
        self._count, self._make = count, make

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> T: ...
    @overload
    def __getitem__(self, index: slice) -> "Lazy[T]": ...
    def __getitem__(self, index: int | slice) -> "T | Lazy[T]":
        chosen = range(self._count)[index]
        if isinstance(chosen, range):
            return Lazy(len(chosen), lambda i: self._make(chosen[i]))
        return self._make(chosen)

    def __iter__(self) -> Iterator[T]:
        return map(self._make, range(self._count))


class Target(NamedTuple):
    """The target in one frame."""

    box: Box
    visible_box: Box | None
    position: Array
    visible: float
    mask: Mask


class Truth(NamedTuple):
    """The geometry of all frames; the first pedestrian is the target."""

    pan: Pan
    hall: Hall
    people: list[Pedestrian]

    def target(self, index: int) -> Target:
        """Box, mask and place of the target in a frame."""
        depth = np.full(self._shape, np.inf)
        first, *others = (self._parts(index, person).ellipsoids for person in self.people)
        for other in others:
            self._lay(other, depth)
        window = self._view.cast(first)
        place, part = window.inside(*self._shape[::-1])
        mask = np.zeros(self._shape, bool)
        mask[place] = np.isfinite(part) & (part <= depth[place])
        alone = np.isfinite(part).sum()
        position = self._view.points(window).mean(axis=0)
        visible = float(mask.sum() / alone) if alone else 0.0
        return Target(self._view.box(first), _round(mask), position, visible, mask)

    def depth(self, index: int) -> Array:
        """What is at each pixel's centre, (H, W) metres along z."""
        return self._seen(index)[0]

    def disparity(self, index: int) -> NDArray[np.float32]:
        """(H, W) pixels, of the left image."""
        rig = self.pan.rig
        return (rig.intrinsics.fx * rig.baseline / self.depth(index)).astype(np.float32)

    def flow(self, index: int) -> NDArray[np.float32]:
        """(H, W, 2) pixels along x and y by which what is at each pixel has moved since the frame before."""
        if index == 0:
            return np.full((*self._shape, 2), np.nan, np.float32)
        depth, owner = self._seen(index)
        now, before = self.pan.to_camera(index), self.pan.to_camera(index - 1)
        moves = [np.column_stack([before @ now.T, np.zeros(3)])]
        for person in self.people:
            was, is_ = self._parts(index - 1, person), self._parts(index, person)
            turn = was.roots @ np.linalg.inv(is_.roots)
            offset = was.centers[:, :, None] - turn @ is_.centers[:, :, None]
            moves += list(np.concatenate([turn, offset], axis=2))
        v, u = np.indices(self._shape)
        points = self.pan.rig.intrinsics.back_project(u, v, depth)
        move = np.stack(moves)[owner]
        earlier = (move[..., :3] @ points[..., None])[..., 0] + move[..., 3]
        return (np.stack([u, v], axis=-1) - self.pan.rig.intrinsics.project(earlier)).astype(np.float32)

    def _seen(self, index: int) -> tuple[Array, NDArray[np.intp]]:
        """Depth (H, W), and whose part is there: 0 for the hall, then all people's parts in order."""
        eye = Eye(self.pan.rig.intrinsics, 0.0, 1)
        depth = self.hall.draw(eye, self.pan.to_camera(index)).depth.astype(np.float64)
        owner = np.zeros(self._shape, np.intp)
        number = 0
        for person in self.people:
            for part in zip(*self._parts(index, person).ellipsoids, strict=True):
                number += 1
                place, nearer = self._lay(Ellipsoids(*(array[None] for array in part)), depth)
                owner[place][nearer] = number
        return depth, owner

    def _lay(self, bodies: Ellipsoids, depth: Array) -> tuple[tuple[slice, slice], Mask]:
        """Put ellipsoids into a z-buffer (H, W); returns where they are nearest."""
        place, part = self._view.cast(bodies).inside(*self._shape[::-1])
        nearer: Mask = part < depth[place]
        np.minimum(depth[place], part, out=depth[place])
        return place, nearer

    def _parts(self, index: int, person: Pedestrian) -> Balls:
        return person.parts[index].moved(self.pan.to_camera(index), np.zeros(3))

    @property
    def _view(self) -> View:
        return View(self.pan.rig.intrinsics, self.pan.height, 0.0)

    @property
    def _shape(self) -> tuple[int, int]:
        return self.pan.rig.intrinsics.height, self.pan.rig.intrinsics.width


def _round(mask: Mask) -> Box | None:
    """The smallest box round a mask's pixels; None where there is none."""
    rows, columns = np.nonzero(mask)
    if len(rows) == 0:
        return None
    return Box(float(columns.min()), float(rows.min()), float(np.ptp(columns) + 1), float(np.ptp(rows) + 1))
