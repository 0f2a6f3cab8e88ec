# SPDX-License-Identifier: MIT
"""The measurement noise, from a head at rest (Moreno et al. 2002, section 4.1)."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from tricue import kernels as kernel_sets
from tricue.arrays import Floats
from tricue.camera.box import BoxLike
from tricue.camera.frame import Frame
from tricue.camera.numbers import positive
from tricue.camera.rig import StereoRig
from tricue.track.base import validation
from tricue.track.stereo_head.measure import measure
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.prepared_pair import PreparedPair
from tricue.track.stereo_head.tracker import StereoHeadTracker

MIN_FRAMES = 10  # with a measurement
MAX_LAG = 15  # frames, of the changes used to separate noise from drift
MIN_COLOR_DEVIATION = 0.1  # levels; a filter without noise or drift would never learn another color
MIN_INTERSECTION_DEVIATION = 0.001
MIN_DISPARITY_DEVIATION = 0.01  # pixels
MIN_REST_RATIO = 0.33  # von Neumann's ratio of a coordinate: about 2 at rest, at least 0.34 in 300 scenes


@dataclass(frozen=True, slots=True, eq=False)
class StaticHead:
    """Measurements of a head at rest in M frames, each with the same prediction and the same model."""

    positions: Floats
    """(M, 3) meters."""
    disparities: Floats
    """(M,) pixels."""
    colors: Floats
    """(M, 3) mean colors, levels."""
    intersections: Floats
    """(M,) intersections (1)."""
    frames: int
    """The number of frames after the first; those beyond M had no disparity."""

    @property
    def noise(self) -> dict[str, Any]:
        """The parameters of :class:`StereoHeadParams` that follow from it: e and Q of the mean color, e of
        the intersection.
        """
        noise, drift = zip(*(split_noise(channel) for channel in self.colors.T), strict=True)
        return {
            "color_noise": _at_least(MIN_COLOR_DEVIATION, noise),
            "color_drift": _at_least(MIN_COLOR_DEVIATION, drift),
            "intersection_noise": max(split_noise(self.intersections)[0], MIN_INTERSECTION_DEVIATION),
        }

    @property
    def moves(self) -> bool:
        """Whether the head seems to move: its positions differ far more overall than from frame to frame."""
        off = self.positions - self.positions[0]  # exactly 0 where nothing moves
        changes = np.mean(np.diff(off, axis=0) ** 2, axis=0)
        return bool((changes < MIN_REST_RATIO * off.var(axis=0, ddof=1)).any())

    def disparity_noise(self, rig: StereoRig, distance: float) -> float:
        """The root mean square error, pixels, of the disparities of a head at a known distance.

        distance: meters along the camera's axis to the mean of the head's visible surface, which is some 7 cm
        in front of the head's center.
        """
        true = rig.intrinsics.fx * rig.baseline / positive(distance, "distance", "meters")
        return max(float(np.sqrt(np.mean((self.disparities - true) ** 2))), MIN_DISPARITY_DEVIATION)


def measure_static_head(
    frames: Iterable[Frame],
    box: BoxLike,
    rig: StereoRig | None = None,
    params: StereoHeadParams | None = None,
    kernels: kernel_sets.Name = "native",
) -> StaticHead:
    """Measure a head that stays in ``box`` in a recording of stereo pairs, without filtering or learning.

    The first frame gives size, disparity and model, from which all others are measured. Without a rig a
    default one is assumed, and positions mean little. ValueError for a box as :meth:`StereoHeadTracker.init`,
    and if the head is measured in fewer than ten, or less than half, of the others.
    """
    stream = iter(frames)
    first = next(stream, None)
    if first is None:
        raise ValueError(f"frames: expected at least {MIN_FRAMES + 1} stereo pairs, got none")
    tracker = StereoHeadTracker(params, rig=rig, kernels=kernels)
    tracker.init(first, box)
    state, p, k = validation.require_initialized(tracker._state), tracker.params, tracker._k
    ellipse = state.geometry.ellipse(state.filter.position, state.size)
    disparity = state.geometry.project(state.filter.position)[2]
    count, rows = 0, []
    for frame in stream:
        count += 1
        try:
            left, right, _ = validation.stereo_pair(frame, state.shape)
        except ValueError as error:
            raise ValueError(f"frame {count}: {error}") from error
        pair = PreparedPair.of(k, left, right, 2 * ellipse[2], state.first_mean, p)
        found = measure(k, pair, state.geometry, ellipse, disparity, state.first_histogram, p)
        if found is not None:
            color = k.histogram_mean(found.histogram, p.color_space)
            rows.append([*found.position, found.depth.disparity, *color, found.match.intersection])
    if len(rows) < max(MIN_FRAMES, count / 2):
        raise ValueError(
            f"frames: expected a head at rest, measured in {MIN_FRAMES} or more stereo pairs after the "
            f"first, which gives the model, and in half of them, got {len(rows)} of {count}"
        )
    table = np.array(rows)
    return StaticHead(table[:, :3], table[:, 3], table[:, 4:7], table[:, 7], count)


def split_noise(values: Floats) -> tuple[float, float]:
    """Standard deviations of a series (M,): of its noise, and of its drift per frame.

    The mean squared change over n frames is 2 noise² + n drift²; both are fitted to the changes over up to 15
    frames. If the series drifts so smoothly that this gives no noise, the noise is the deviation from a
    straight line through three frames.
    """
    lags = np.arange(1, max(2, min(len(values) // 4, MAX_LAG)) + 1)
    changes = np.array([np.mean((values[lag:] - values[:-lag]) ** 2) for lag in lags])
    drift, twice_noise = np.polyfit(lags, changes, 1, w=1 / lags)  # changes over long lags overlap
    if drift < 0:
        drift, twice_noise = 0.0, changes.mean()
    if twice_noise < 0:
        twice_noise = np.mean(np.diff(values, 2) ** 2) / 3
        drift = max(changes[0] - twice_noise, 0.0)
    return float(np.sqrt(twice_noise / 2)), float(np.sqrt(drift))


def _at_least(least: float, values: Iterable[float]) -> tuple[float, ...]:
    return tuple(max(value, least) for value in values)
