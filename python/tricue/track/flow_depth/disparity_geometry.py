# SPDX-License-Identifier: MIT
"""The camera numbers that turn disparities into meters, of a parallel or a verged stereo pair."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import StereoRig


class DisparityGeometry(NamedTuple):
    """The geometry of a stereo pair, or, with a default baseline, of a depth camera.

    camera: (4,) fx, fy, cx, cy, pixels. baseline: meters. angle: radians by which the right camera is turned
    inwards. Its image is turned back and moved by ``offset`` pixels to the right, so that what both cameras
    see stays in it. is_metric: whether its meters are true, as those of a pair aren't whose rig is guessed.
    """

    camera: NDArray[np.float64]
    baseline: float
    angle: float = 0.0
    is_metric: bool = True

    @classmethod
    def of(cls, rig: StereoRig, vergence: float, is_metric: bool = True) -> "DisparityGeometry":
        """The geometry of a rig; vergence in degrees."""
        return cls(rig.intrinsics.vector, rig.baseline, math.radians(vergence), is_metric)

    @property
    def disparity_times_depth(self) -> float:
        """Focal length times baseline, pixels times meters."""
        return float(self.camera[0] * self.baseline)

    @property
    def offset(self) -> float:
        """By which measured disparities are smaller than those of parallel cameras, pixels."""
        return float(self.camera[0] * math.tan(self.angle)) if self.angle else 0.0
