# SPDX-License-Identifier: MIT
"""Scenes: the frames of a sequence, and the exact truth in each."""

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
    """A rendered color sequence and its exact truth; the same arguments give the same bits."""

    name: str
    frames: tuple[Frame, ...]
    boxes: tuple[Box, ...]
    """The true box in each frame, pixels."""
    changes: tuple[int, ...] = ()
    """The frames in which the light or the brightness of the target changes abruptly."""
    visible: tuple[float, ...] = ()
    """The visible share of the target in each frame; empty if nothing ever hides it."""


class Bystander(NamedTuple):
    """Another person in a frame; box and position are defined as the target's."""

    box: Box
    position: NDArray[np.float64]  # (3,) meters, camera frame


@dataclass(frozen=True, slots=True, eq=False)
class DepthScene:
    """A rendered depth sequence and its exact truth; the same arguments give the same bits.

    The truth is that of the geometry, before the sensor's noise and missing pixels.
    """

    name: str
    frames: tuple[Frame, ...]
    """Each with ``depth`` (H, W), meters, and ``timestamp``, seconds from 0."""
    boxes: tuple[Box, ...]
    """Around the target's whole body, pixels, hidden parts included; it may reach beyond the image."""
    visible_boxes: tuple[Box | None, ...]
    """Around the target's visible pixels; None where none is visible."""
    positions: NDArray[np.float64]
    """(M, 3) meters in the camera frame (x right, y down, z forward): the mean of the surface points at the
    target's pixels when it is rendered alone, pixels beyond the image included. It lies on the surface that
    faces the camera, some centimeters in front of the body's axis, and moves slightly with the limbs."""
    visible: NDArray[np.float64]
    """(M,) share of the target's pixels that are visible, of those in the image when it is rendered alone."""
    intrinsics: Intrinsics
    others: tuple[tuple[Bystander, ...], ...]
    """The other people in each frame, in the same order; they may be outside the image."""


@dataclass(frozen=True, slots=True, eq=False)
class StereoScene:
    """A rendered stereo sequence of a head and its exact truth; the same arguments give the same bits.

    The pair is rectified. The truth is that of the geometry, before noise. The head is the ellipsoid of skull
    and hair, without neck and ears.
    """

    name: str
    frames: tuple[Frame, ...]
    """Each with ``color``, the left image, ``right``, and ``timestamp``, seconds from 0."""
    boxes: tuple[Box, ...]
    """Around the whole head's outline in the left image, pixels, hidden parts included."""
    positions: NDArray[np.float64]
    """(M, 3) meters in the left camera's frame: the mean of the surface points at the head's pixels in the
    left image, as if nothing hid it. Stereo measures this point: some 7 cm in front of the head's center, on
    nearly the same line of sight."""
    visible: NDArray[np.float64]
    """(M,) share of the head's pixels in the left image that are visible, of those not behind the neck."""
    facing: NDArray[np.float64]
    """(M,) angle between the face's direction and the camera, radians: 0 is frontal, pi shows only hair."""
    light: NDArray[np.float64]
    """(M,) the light's gain; 1 leaves the textures' levels unchanged."""
    changes: tuple[int, ...]
    """The frames in which the light changes abruptly."""
    rig: StereoRig


class Events(NamedTuple):
    """The frames in which the events of an overtaking happen; None for an event after the last frame."""

    hiding: int | None
    """The first frame in which less than 60 % of the target is visible."""
    hidden: int | None
    """The first frame with less than 10 %."""
    back: int | None
    """The first frame with more than 20 % after that."""
    passing: int | None
    """The frame in which the target passes the standing person, both on one line of sight."""


@dataclass(frozen=True, slots=True, eq=False)
class WalkScene:
    """A rendered sequence of walkers in front of a panning stereo pair or RGB-D camera, and its exact truth.

    The same arguments give the same bits. The truth is that of the geometry at the pixels' centers, before
    noise, in the image and frame of the left (or color) camera.
    """

    name: str
    frames: tuple[Frame, ...]
    """Each with ``color``, ``right`` or ``depth`` (H, W), meters, and ``timestamp``, seconds from 0."""
    boxes: tuple[Box, ...]
    """Around the target's whole body, pixels, hidden parts included; it may reach beyond the image."""
    visible_boxes: tuple[Box | None, ...]
    """Around the target's visible pixels; None where none is visible."""
    positions: NDArray[np.float64]
    """(M, 3) meters in the left camera's frame: the mean of the surface points at the target's pixels, as
    if nothing hid it, as in :class:`DepthScene`."""
    visible: NDArray[np.float64]
    """(M,) share of the target's pixels that are visible, of those it has when rendered alone."""
    masks: tuple[NDArray[np.bool_], ...]
    """(H, W) each: the target's visible pixels."""
    flow: Sequence[NDArray[np.float32]]
    """(H, W, 2) each, computed on access: motion along x and y since the last frame of the surface at each
    pixel, in pixels; NaN in the first frame."""
    disparity: Sequence[NDArray[np.float32]]
    """(H, W) each, computed on access: x_left - x_right in pixels."""
    others: tuple[tuple[Bystander, ...], ...]
    """The overtaking and the standing person in each frame; they may be outside the image."""
    rig: StereoRig
    """The stereo rig; in scenes with depth instead of a right image its right camera takes no image."""
    events: Events
    vergence: float = 0.0
    """Degrees by which the right camera is turned inward; ``rig`` has the numbers of a parallel pair."""
