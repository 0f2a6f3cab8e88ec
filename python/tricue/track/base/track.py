# SPDX-License-Identifier: MIT
"""The interface of all trackers: Track, Status and the Tracker protocol."""

from dataclasses import dataclass, replace
from enum import Enum
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box, BoxLike
from tricue.camera.frame import FrameLike
from tricue.camera.pose import Pose
from tricue.track.base.traits import Traits


class Status(str, Enum):
    """TRACKED: visible. OCCLUDED: hidden, the box is a prediction. LOST: the tracker is searching."""

    TRACKED = "tracked"
    OCCLUDED = "occluded"
    LOST = "lost"

    def __str__(self) -> str:
        return self.value


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Track:
    """Where the target is in one frame.

    box: pixels; it may extend beyond the image.
    score: confidence; in [0, 1] for our trackers.
    position: (3,) float64, meters in the camera frame (x right, y down, z forward), or None without depth.
        While the target is OCCLUDED or LOST it is a prediction, not None: check the status before a robot
        moves.
    covariance: (3, 3) of the position, square meters, or None.
    depth: meters along the camera's axis; None until it was measured, and where meters are a guess. A depth
        image gives it without a calibration. If there is a position too, this is its z.
    pose: the camera's pose, or None; see :class:`tricue.Pose`.
    """

    box: Box
    score: float
    status: Status
    position: NDArray[np.float64] | None = None
    covariance: NDArray[np.float64] | None = None
    depth: float | None = None
    pose: Pose | None = None

    @property
    def world_position(self) -> NDArray[np.float64] | None:
        """The position (3,) in the world's frame, meters; None without position or pose."""
        if self.position is None or self.pose is None:
            return None
        return self.pose.to_world(self.position)

    @property
    def world_covariance(self) -> NDArray[np.float64] | None:
        """The covariance (3, 3) of the world position, square meters, or None; the pose is assumed exact."""
        if self.covariance is None or self.pose is None:
            return None
        return self.pose.covariance_to_world(self.covariance)

    def in_image(self) -> "Track":
        """The same track without position and covariance, for an unknown camera."""
        return replace(self, position=None, covariance=None)

    __hash__ = None  # type: ignore[assignment]  # arrays have none

    def __eq__(self, other: object) -> bool:
        """Bit-exact equality, arrays included, so that runs can be compared."""
        if not isinstance(other, Track):
            return NotImplemented
        mine, theirs = ((each.box, each.score, each.status, each.depth, each.pose) for each in (self, other))
        if mine != theirs:
            return False
        return _same(self.position, other.position) and _same(self.covariance, other.covariance)

    def __repr__(self) -> str:
        words = [repr(self.box), f"score={self.score!r}", f"status={str(self.status)!r}"]
        arrays = {"position": self.position, "covariance": self.covariance}
        words += [f"{name}={array.tolist()}" for name, array in arrays.items() if array is not None]
        others = {"depth": self.depth, "pose": self.pose}
        words += [f"{name}={value!r}" for name, value in others.items() if value is not None]
        return f"Track({', '.join(words)})"

    def _repr_html_(self) -> str:
        from tricue.notebook.tracks import track_html

        return track_html(self)


class Tracker(Protocol):
    """The interface of a tracker: start it with ``init``, then call ``update`` once per frame.

    Those of the package keep no reference to a frame's arrays and don't write to them: after a call, the
    caller may overwrite them. Arrays that they return don't change in later calls. Use a tracker in one
    thread at a time; different trackers may run in different threads, as the kernels release the GIL.
    """

    traits: ClassVar[Traits]

    @property
    def params(self) -> Any: ...

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on ``box``; without it the tracker finds a target or raises ValueError."""

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame; RuntimeError before ``init``."""


def _same(a: NDArray[np.float64] | None, b: NDArray[np.float64] | None) -> bool:
    return a is b if a is None or b is None else np.array_equal(a, b, equal_nan=True)
