# SPDX-License-Identifier: MIT
"""What every scene is: frames and the truth in each."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics


@dataclass(frozen=True, slots=True)
class Scene:
    """A sequence made by this package, so that its truth is exact; the same arguments give the same bits."""

    name: str
    frames: tuple[Frame, ...]
    boxes: tuple[Box, ...]
    """The true box in each frame, pixels."""
    changes: tuple[int, ...] = ()
    """The frames in which the light or the brightness of the target changes abruptly."""


class Bystander(NamedTuple):
    """Where somebody who isn't the target is in a frame; box and position are defined as the target's."""

    box: Box
    position: NDArray[np.float64]  # (3,) metres, camera frame


@dataclass(frozen=True, slots=True, eq=False)
class DepthScene:
    """A sequence of depth frames made by this package; the same arguments give the same bits.

    The truth is that of the geometry, before the sensor's noise and gaps.
    """

    name: str
    frames: tuple[Frame, ...]
    """Each with ``depth`` (H, W), metres, and ``timestamp``, seconds from 0."""
    boxes: tuple[Box, ...]
    """Round the target's whole body, pixels, whatever hides it; it may reach over the image's edge."""
    visible_boxes: tuple[Box | None, ...]
    """Round the target's pixels that are seen in the image; None where none is."""
    positions: NDArray[np.float64]
    """(M, 3) metres in the camera frame (x right, y down, z forward): the mean of the surface points that the
    target's pixels see, rendered alone, those beyond the image's edge included. It lies on the side that
    faces the camera, some centimetres before the body's axis, and moves a little with the limbs."""
    visible: NDArray[np.float64]
    """(M,) share of the target's pixels that nothing hides, of those it would have alone in the image."""
    intrinsics: Intrinsics
    others: tuple[tuple[Bystander, ...], ...]
    """The other people in each frame, always in the same order; they may be outside the image."""
