# SPDX-License-Identifier: MIT
"""A frame as it is measured: gray, at most so many columns wide, with a right image or depth as disparity."""

import math
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from tricue.camera.frame import Frame
from tricue.camera.rig import StereoRig
from tricue.kernels import Kernels
from tricue.track.flow_depth.params import FlowDepthParams

Image = NDArray[np.uint8]
Plane = NDArray[np.float32]


class Lens(NamedTuple):
    """What turns disparities into metres: of a pair, or, with a usual baseline, of a depth camera.

    camera: (4,) fx, fy, cx, cy, pixels. baseline: metres. angle: radians by which the right camera is turned
    inwards; its picture is turned back and moved by ``shift`` pixels to the right, so that what both see
    stays in it.
    """

    camera: NDArray[np.float64]
    baseline: float
    angle: float = 0.0

    @classmethod
    def of(cls, rig: StereoRig, vergence: float) -> "Lens":
        """The numbers of a rig; vergence in degrees."""
        lens = rig.intrinsics
        return cls(np.array([lens.fx, lens.fy, lens.cx, lens.cy]), rig.baseline, math.radians(vergence))

    @property
    def product(self) -> float:
        """Pixels times metres: disparity times depth."""
        return float(self.camera[0] * self.baseline)

    @property
    def shift(self) -> float:
        """By which measured disparities are too small, pixels."""
        return float(self.camera[0] * math.tan(self.angle))


class View(NamedTuple):
    """A place is ``step`` x ``step`` pixels. gray, right: (h, w) of the places, right None without.
    disparity: (h, w) places, of a depth image, NaN where it has none; None without. shift: by which
    disparities are smaller than those of parallel cameras, places.
    """

    gray: Image
    right: Image | None
    disparity: Plane | None
    step: int
    shift: float = 0.0

    @property
    def scale(self) -> float:
        """Places here over those of the paper's pictures, of 160 columns."""
        return float(self.gray.shape[1] / 160)

    def depth_scale(self, p: FlowDepthParams) -> float:
        """The same for lengths in disparity: of a depth camera they are shorter."""
        return self.scale * (1.0 if self.disparity is None else p.sharp)


def view_of(k: Kernels, frame: Frame, lens: Lens, p: FlowDepthParams) -> View:
    """The channels of a checked frame that the cues need, made smaller."""
    image = frame.color if frame.color is not None else frame.depth
    assert image is not None
    height, width = image.shape[:2]
    step = max(1, min(round(width / p.resolution), height, width))
    gray = (
        _smaller(_gray(frame.color), step)
        if frame.color is not None
        else np.zeros((height // step, width // step), np.uint8)
    )
    if "disparity" not in p.cues:
        return View(gray, None, None, step)
    if frame.right is None:
        assert frame.depth is not None
        return View(gray, None, _disparity(frame.depth, lens, step), step, lens.shift / step)
    right = _gray(frame.right)
    if lens.angle:
        camera = lens.camera
        center = float(camera[2]), float(camera[3])
        right = k.rectify_verged(right, lens.angle, float(camera[0]), center, lens.shift)
    return View(gray, _smaller(right, step), None, step, lens.shift / step)


def _gray(image: Image) -> Image:
    """A copy, as the next frame's flow needs it, when the caller may have put that one into this one's
    array.
    """
    if image.ndim == 2:
        return np.array(image)
    return cv2.cvtColor(image, cv2.COLOR_BGR2GRAY).astype(np.uint8, copy=False)


def _smaller(image: Image, step: int) -> Image:
    if step == 1:
        return image
    height, width = (size // step for size in image.shape)
    whole = image[: height * step, : width * step]
    return cv2.resize(whole, (width, height), interpolation=cv2.INTER_AREA).astype(np.uint8, copy=False)


def _disparity(depth: Plane, lens: Lens, step: int) -> Plane:
    """Of the middle pixel of each place, in places: as a pair of the lens would measure it."""
    height, width = (size // step for size in depth.shape)
    middle = depth[step // 2 :: step, step // 2 :: step][:height, :width]
    with np.errstate(divide="ignore", over="ignore"):
        found = np.float32(lens.product / step) / middle - np.float32(lens.shift / step)
    found[~np.isfinite(found)] = np.nan
    return np.ascontiguousarray(found)
