# SPDX-License-Identifier: MIT
"""The target's depth: it tells its pixels, its size, and its occluders."""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from tricue.track.base.params import Params, parameter
from tricue.track.fused.arrays import Plane
from tricue.track.fused.depth_sources import GATE_SIGMAS, MAX_EXPECTED_SIGMA, ExpectedDepth
from tricue.track.fused.sources import OURS
from tricue.track.fused.target import Target
from tricue.track.fused.target_observation import TargetObservation
from tricue.track.fused.window import INNER_SHARE, Window

DEPTH_SAMPLES = 48  # on a side of the part in which the target's depth is measured
MIN_MEASURED_SHARE = 0.1  # of the samples
INITIAL_DEPTH_SPREAD = 0.1  # meters, of a target that was never measured
MIN_DEPTH_SPREAD, MAX_DEPTH_SPREAD = 0.04, 0.4  # meters
MAX_GROWTH_PER_FRAME = 1.25  # times
SURROUND_SIZE = 2.0  # of the box: what depth_continuity compares it with
FULL_WEIGHT_SIGMA = 0.25  # meters; a vaguer expected depth counts less in depth_continuity
DEPTH_CENTER_SHARE = 0.5  # of the box's sides: the part that is the target's where no depth is expected
MIN_MEASURED_DEPTH, MAX_MEASURED_DEPTH = 0.001, 1000.0  # meters; what is beyond counts as not measured
MAX_DEPTH_OFFSET = 0.5  # meters from the median of that part
MAD_TO_SIGMA = 1.4826  # from the median absolute deviation to normal noise's standard deviation


@dataclass(frozen=True, kw_only=True)
class DepthParams(Params):
    """Of the cue "depth"."""

    depth_learning_rate: float = parameter(
        0.02,
        unit="per frame",
        source=OURS,
        low=0,
        high=1,
        doc="of the target's depth spread and length",
        was="depth_rate",
    )
    depth_continuity_weight: float = parameter(
        8.0,
        unit="log-odds",
        source=OURS,
        low=0,
        doc="for what stands apart at the expected depth",
        was="continuity",
    )


class DepthExpert(NamedTuple):
    """What is known of the target's shape in meters.

    depth_spread: standard deviation of its surface's depth. length: side of the square with its area, if it
    is flat and faces the camera.
    """

    depth_spread: float
    length: float

    @classmethod
    def from_measurement(cls, depth: "DepthMeasurement", length: float) -> "DepthExpert":
        """Learned from the first measurement."""
        return cls(INITIAL_DEPTH_SPREAD, length).learn(depth, length, 1.0)

    def posterior(self, window: Window) -> Plane | None:
        """(64, 64) P(target | depth)."""
        return None if window.depth is None else window.depth[0]

    def growth(self, depth: "DepthMeasurement", side: float) -> float:
        """The ratio of the target's size at a measured depth to a side in pixels."""
        growth = self.length / (depth.z * side)
        return min(max(growth, 1 / MAX_GROWTH_PER_FRAME), MAX_GROWTH_PER_FRAME)

    def learn(self, depth: "DepthMeasurement", length: float, rate: float) -> "DepthExpert":
        """The expert with a measurement blended in, the length by the geometric mean."""
        spread = min(max(depth.spread, MIN_DEPTH_SPREAD), MAX_DEPTH_SPREAD)
        return DepthExpert(
            self.depth_spread + rate * (spread - self.depth_spread),
            self.length * (length / self.length) ** rate,
        )


class DepthMeasurement(NamedTuple):
    """z: median depth of a target's pixels, spread: their standard deviation, in meters.

    share: of the samples in its box, that are measured and near z.
    """

    z: float
    spread: float
    share: float


def measure_depth(
    observation: TargetObservation, target: Target, expected: ExpectedDepth | None
) -> DepthMeasurement | None:
    """The depth of what is in a target's box, near the expected depth.

    Where that is None or vague, the depth of the box's center. None where too little is measured.
    """
    if observation.depth_source is None:
        return None
    if expected is not None and expected.sigma > MAX_EXPECTED_SIGMA:
        expected = None
    side = DEPTH_CENTER_SHARE * target.side if expected is None else max(target.width, target.height)
    pixel_size = side / DEPTH_SAMPLES
    corner = target.x - side / 2, target.y - side / 2
    depths = observation.depth_source.sample((*corner, pixel_size), DEPTH_SAMPLES, expected)
    if expected is None:
        inside = (depths > MIN_MEASURED_DEPTH) & (depths < MAX_MEASURED_DEPTH)
        center = float(np.median(depths[inside])) if inside.any() else math.nan
        max_offset = MAX_DEPTH_OFFSET
    else:
        offset = np.abs((np.arange(DEPTH_SAMPLES) + 0.5) / DEPTH_SAMPLES - 0.5) * 2 * side
        inside = (offset[:, None] / target.height) ** 2 + (offset / target.width) ** 2 <= 1
        center = expected.z
        noise = observation.depth_source.noise(expected.z, pixel_size)
        max_offset = GATE_SIGMAS * math.hypot(expected.sigma, noise)
    chosen = depths[inside & (np.abs(depths - np.float32(center)) < max_offset)]
    if len(chosen) < MIN_MEASURED_SHARE * np.count_nonzero(inside) or not len(chosen):
        return None
    z = float(np.median(chosen))
    spread = MAD_TO_SIGMA * float(np.median(np.abs(chosen - z)))
    return DepthMeasurement(z, spread, len(chosen) / np.count_nonzero(inside))


def covered_share(window: Window, right: float = 0.0, down: float = 0.0) -> float:
    """The share of a target's box, so many patch pixels off the window's center, that an occluder covers."""
    if window.depth is None:
        return 0.0
    return float(window.depth[1][window.inner(right, down, INNER_SHARE)].mean())


def depth_continuity(window: Window, right: float, down: float) -> float:
    """How far a target, so many patch pixels off the window's center, stands apart at the expected depth.

    In [0, 1]: mean P(target | depth) in its box less that around it, less where the expectation is vague; 0
    without depth.
    """
    expected = window.observation.expected_depth
    if window.depth is None or expected is None:
        return 0.0
    inner, outer = (
        window.depth[0][window.inner(right, down, share)] for share in (INNER_SHARE, SURROUND_SIZE)
    )
    inside, outside = float(inner.sum()), float(outer.sum()) - float(inner.sum())
    contrast = inside / inner.size - outside / max(outer.size - inner.size, 1)
    return max(contrast, 0.0) * min(FULL_WEIGHT_SIGMA / expected.sigma, 1.0) ** 2
