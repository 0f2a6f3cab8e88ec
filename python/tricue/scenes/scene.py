# SPDX-License-Identifier: MIT
"""What every scene is: frames and the truth in each."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.camera.rig import Intrinsics, StereoRig


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


@dataclass(frozen=True, slots=True, eq=False)
class StereoScene:
    """A head before a rectified stereo pair, made by this package; the same arguments give the same bits.

    The truth is that of the geometry, before noise. Head means the ellipsoid that holds skull and hair,
    without neck and ears.
    """

    name: str
    frames: tuple[Frame, ...]
    """Each with ``color``, the left image, ``right``, and ``timestamp``, seconds from 0."""
    boxes: tuple[Box, ...]
    """Round the whole head's outline in the left image, which is an ellipse; pixels, whatever hides it."""
    positions: NDArray[np.float64]
    """(M, 3) metres in the left camera's frame: the mean of the surface points that the head's pixels in the
    left image see, as if nothing hid it. That is what stereo can measure: a point some 7 cm before the
    head's centre, on nearly the same line of sight."""
    visible: NDArray[np.float64]
    """(M,) share of the head's pixels in the left image that nothing but the own neck hides."""
    facing: NDArray[np.float64]
    """(M,) angle between where the face looks and the camera, radians: 0 full face, pi only hair."""
    light: NDArray[np.float64]
    """(M,) the light's gain; 1 is the light in which the textures have their levels."""
    changes: tuple[int, ...]
    """The frames in which the light changes abruptly."""
    rig: StereoRig


class Events(NamedTuple):
    """The frames in which the story of an overtaking goes on; None for what comes after the last one."""

    hiding: int | None
    """The first in which less than 60 % of the target is visible."""
    hidden: int | None
    """The first with less than 10 %."""
    back: int | None
    """The first with more than 20 % after that."""
    passing: int | None
    """The one in which the target passes who stands, both being on the same line of sight."""


@dataclass(frozen=True, slots=True, eq=False)
class WalkScene:
    """Walkers before a turning stereo pair or color and depth camera, made by this package.

    The same arguments give the same bits. The truth is that of the geometry at the pixels' centres, before
    noise, in the left (or color) camera's image and frame.
    """

    name: str
    frames: tuple[Frame, ...]
    """Each with ``color``, ``right`` or ``depth`` (H, W), metres, and ``timestamp``, seconds from 0."""
    boxes: tuple[Box, ...]
    """Round the target's whole body, pixels, whatever hides it; it may reach over the image's edge."""
    visible_boxes: tuple[Box | None, ...]
    """Round the target's pixels that are seen in the image; None where none is."""
    positions: NDArray[np.float64]
    """(M, 3) metres in the left camera's frame: the mean of the surface points that the target's pixels see,
    as if nothing hid it, as in :class:`DepthScene`."""
    visible: NDArray[np.float64]
    """(M,) share of the target's pixels that nothing hides, of those it would have alone."""
    masks: tuple[NDArray[np.bool_], ...]
    """(H, W) each: the target's visible pixels."""
    flow: Sequence[NDArray[np.float32]]
    """(H, W, 2) each, made on demand: pixels along x and y by which the surface at each pixel has moved since
    the frame before; NaN in the first."""
    disparity: Sequence[NDArray[np.float32]]
    """(H, W) each, made on demand: pixels, x_left - x_right."""
    others: tuple[tuple[Bystander, Bystander], ...]
    """Who overtakes and who stands in each frame; they may be outside the image."""
    rig: StereoRig
    """The pair; with depth instead of a right image the right camera is only thought of."""
    events: Events
