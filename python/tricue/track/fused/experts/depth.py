# SPDX-License-Identifier: MIT
"""The depth expert: depth tells which pixels are the target's, how large it is, and what covers it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import cv2
import numpy as np

from tricue.arrays import Floats
from tricue.track.base.params import Params, parameter
from tricue.track.fused.depth_sources import GATE_SIGMAS, MAX_EXPECTED_SIGMA, ExpectedDepth
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.sources import PROTOTYPE
from tricue.track.fused.target import Target
from tricue.track.fused.window import INNER_SHARE, Window

DEPTH_SAMPLES = 48  # on a side of the square in which the target's depth is measured
MIN_MEASURED_SHARE = 0.1  # of the samples
INITIAL_DEPTH_SPREAD = 0.1  # meters, before depth is measured
MIN_DEPTH_SPREAD, MAX_DEPTH_SPREAD = 0.04, 0.4  # meters
MAX_GROWTH_PER_FRAME = 1.25  # ratio of sizes
SURROUND_SIZE = 2.0  # of the box: outer size of the surround in depth_continuity
FULL_WEIGHT_SIGMA = 0.25  # meters; a less certain expected depth has less weight in depth_continuity
DEPTH_CENTER_SHARE = 0.5  # of the target's side: the central square that is measured if no depth is expected
MAX_CENTER_SIDE = 1.5  # of the box's shorter side, so that a thin target fills two thirds of that square
MAX_DEPTH_OFFSET = 0.5  # meters from the median of that square


@dataclass(frozen=True, kw_only=True)
class DepthParams(Params):
    """The parameters of the cue "depth"."""

    depth_learning_rate: float = parameter(
        0.02,
        unit="per frame",
        source=PROTOTYPE,
        low=0,
        high=1,
        doc="learning rate of the target's depth spread and length",
        was="depth_rate",
    )
    depth_continuity_weight: float = parameter(
        8.0,
        unit="log-odds",
        source=PROTOTYPE,
        low=0,
        doc="weight of a place that stands apart at the expected depth",
        was="continuity",
    )


class DepthExpert(NamedTuple):
    """The target's extent in depth, and its size.

    depth_spread: standard deviation of its surface's depth, meters. length: side of the square with the
    target's area, times the focal length: pixels times meters, so that length / depth is its side in pixels.
    """

    depth_spread: float
    length: float

    @classmethod
    def from_measurement(cls, depth: "DepthMeasurement", length: float) -> "DepthExpert":
        """The expert learned from the first measurement."""
        return cls(INITIAL_DEPTH_SPREAD, length).learn(depth, length, 1.0)

    def growth(self, depth: "DepthMeasurement", side: float) -> float:
        """The ratio of the target's side at a measured depth to ``side``, in pixels; limited."""
        growth = self.length / (depth.z * side)
        return min(max(growth, 1 / MAX_GROWTH_PER_FRAME), MAX_GROWTH_PER_FRAME)

    def learn(self, depth: "DepthMeasurement", length: float, rate: float) -> "DepthExpert":
        """The expert with a measurement blended in; lengths are averaged geometrically."""
        spread = min(max(depth.spread, MIN_DEPTH_SPREAD), MAX_DEPTH_SPREAD)
        return DepthExpert(
            self.depth_spread + rate * (spread - self.depth_spread),
            self.length * (length / self.length) ** rate,
        )


class DepthMeasurement(NamedTuple):
    """The depth measured in a target's box; see ``median_depths``.

    z: median depth of the target's pixels, meters. spread: robust standard deviation of their depths, meters.
    share: of the samples that are the target's.
    """

    z: float
    spread: float
    share: float


def measure_depth(
    observation: PictureObservation, target: Target, expected: ExpectedDepth | None
) -> DepthMeasurement | None:
    """The depth in a target's box, from pixels near the expected depth.

    If the expected depth is None or uncertain, the depth at the box's center. None if too little is measured.
    """
    if expected is None or expected.sigma > MAX_EXPECTED_SIGMA:
        return measure_center_depths(observation, [target])[0]
    k, source = observation.k, observation.depth_source
    if source is None:
        return None
    noise = source.noise(expected.z, max(target.width, target.height) / DEPTH_SAMPLES)
    gate = GATE_SIGMAS * math.hypot(expected.sigma, noise), MIN_MEASURED_SHARE
    return _measurements(source.medians(k, np.array([target[:4]]), DEPTH_SAMPLES, expected, gate))[0]


def measure_center_depths(
    observation: PictureObservation, targets: Sequence[Target]
) -> list[DepthMeasurement | None]:
    """The depths at the centers of targets, without an expected depth; None where too little is measured."""
    if observation.depth_source is None:
        return [None] * len(targets)
    squares = np.array([_center_square(each, observation.shape) for each in targets])
    gate = MAX_DEPTH_OFFSET, MIN_MEASURED_SHARE
    return _measurements(observation.depth_source.medians(observation.k, squares, DEPTH_SAMPLES, None, gate))


def _center_square(target: Target, shape: tuple[int, int]) -> tuple[float, float, float, float]:
    """Center and sides of the square in which a target's depth is measured if none is expected.

    If the target's center isn't in the image, the square is in the middle of the target's visible part.
    """
    height, width = shape
    x, y, *sides = target[:4]
    if not (0 <= x <= width and 0 <= y <= height) and (visible := target.box.clip(width, height)).area:
        (x, y), sides = visible.center, [visible.width, visible.height]
    side = min(DEPTH_CENTER_SHARE * target.side, MAX_CENTER_SIDE * min(sides))
    return x, y, side, side


def _measurements(medians: Floats) -> list[DepthMeasurement | None]:
    return [None if math.isnan(z) else DepthMeasurement(z, *rest) for z, *rest in medians.tolist()]


def covered_share(window: Window, right: float = 0.0, down: float = 0.0) -> float:
    """The share of a target's box that an occluder covers.

    right, down: patch pixels from the window's center to the target's.
    """
    if not window.has_occluder:
        return 0.0
    assert window.depth is not None, "it has the occluder"
    nearer = window.depth.occluded[window.inner(right, down, INNER_SHARE)]
    return cv2.countNonZero(nearer) / nearer.size


def depth_continuity(window: Window, right: float, down: float) -> float:
    """How much a target stands apart at the expected depth, in [0, 1]; 0 without depth.

    This is the mean P(target | depth) in its box minus that around it, reduced if the expected depth is
    uncertain. right, down: patch pixels from the window's center to the target's.
    """
    expected = window.observation.expected_depth
    if window.depth is None or expected is None:
        return 0.0
    inner, outer = (
        window.depth.posterior[window.inner(right, down, share)] for share in (INNER_SHARE, SURROUND_SIZE)
    )
    inside = float(np.add.reduce(inner, axis=None))
    outside = float(np.add.reduce(outer, axis=None)) - inside
    contrast = inside / inner.size - outside / max(outer.size - inner.size, 1)
    return max(contrast, 0.0) * min(FULL_WEIGHT_SIGMA / expected.sigma, 1.0) ** 2
