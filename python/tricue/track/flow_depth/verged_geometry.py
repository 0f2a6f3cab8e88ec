# SPDX-License-Identifier: MIT
"""The conversion of disparities to meters for a parallel or verged stereo pair."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.camera.rig import StereoRig


class VergedGeometry(NamedTuple):
    """The geometry of a stereo pair, or, with a default baseline, of a depth camera.

    camera: (4,) fx, fy, cx, cy, pixels. baseline: meters. angle: radians by which the right camera is turned
    inward. Its image is rotated back and moved by ``offset`` pixels to the right, to keep what both cameras
    see inside it. is_metric: whether its meters are true; they aren't for a guessed rig.
    """

    camera: NDArray[np.float64]
    baseline: float
    angle: float = 0.0
    is_metric: bool = True

    @classmethod
    def of(cls, rig: StereoRig, vergence: float, is_metric: bool = True) -> "VergedGeometry":
        """The geometry of a rig; vergence in degrees."""
        return cls(rig.intrinsics.vector, rig.baseline, math.radians(vergence), is_metric)

    @property
    def disparity_times_depth(self) -> float:
        """Focal length times baseline, pixels times meters."""
        return float(self.camera[0] * self.baseline)

    @property
    def offset(self) -> float:
        """How much smaller measured disparities are than those of parallel cameras, pixels."""
        return float(self.camera[0] * math.tan(self.angle)) if self.angle else 0.0
