# SPDX-License-Identifier: MIT
"""The target's size: in log-polar coordinates around its center a change of size is a shift.

A correlation filter answers to it as to a shift in the image (Reddy and Chatterji 1996; Li, Zhu, Hoi, Song,
Wang and Liu 2019). This one is a running mean over frames (Danelljan et al. 2014): one that is learned from a
frame at a time lets the size wander.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.params import parameter
from tricue.track.fused.arrays import Image, Plane
from tricue.track.fused.experts.spectra import CHANNELS, FirstFrameParams, Spectra, label_spectrum
from tricue.track.fused.sources import OURS
from tricue.track.fused.target import Target
from tricue.track.fused.target_observation import TargetObservation
from tricue.track.fused.window import CELL_PIXELS, PATCH_PIXELS, WINDOW_CELLS

Filter = tuple[Spectra, Plane]  # numerator and denominator

INNER_RADIUS, OUTER_RADIUS = 0.3, 2.5  # of the log-polar patch, in halves of the box's sides
LABEL_WIDTH = 0.7  # cells
MAX_SHIFT = 2  # cells of radius, from one frame to the next
MAX_TURN = 1  # cells of angle
LOG_PER_CELL = CELL_PIXELS * math.log(OUTER_RADIUS / INNER_RADIUS) / PATCH_PIXELS


@dataclass(frozen=True, kw_only=True)
class SizeParams(FirstFrameParams):
    """Of the cue "size"."""

    size_learning_rate: float = parameter(
        0.025,
        unit="per frame",
        source="Danelljan et al. 2014",
        low=0,
        high=0.5,
        doc="of its filter",
        was="filter_rate",
    )
    ridge: float = parameter(
        1e-2, unit="of the mean energy", source=OURS, above=0, doc="regularization of its filter"
    )
    size_change_penalty: float = parameter(
        0.05, unit="per squared cell", source=OURS, low=0, doc="on the evidence of another size than the last"
    )
    size_range: tuple[float, float] = parameter(
        (0.2, 5.0), unit="of the first size", source=OURS, above=0, doc="limits of the size"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.size_range[0] > self.size_range[1]:
            raise ValueError(f"size_range: expected the lower number first, got {self.size_range}")


class SizeExpert(NamedTuple):
    """A correlation filter on a log-polar patch.

    learned, first: numerator (19, 32, 17) and denominator (32, 17), as they are learned, and of the first
    frame. applied: (1, 19, 32, 17) the learned one with a share of the first frame's, divided.
    """

    learned: Filter
    first: Filter
    applied: Spectra
    params: SizeParams

    @classmethod
    def from_target(cls, observation: TargetObservation, target: Target, p: SizeParams) -> "SizeExpert":
        """Learned from the first frame."""
        empty = np.zeros((CHANNELS, *LABEL.shape), np.complex64), np.zeros(LABEL.shape, np.float32)
        first, applied = cls(empty, empty, empty[0], p)._learn(observation, target, 1.0, 0.0)
        return cls(first, first, applied, p)

    def growth(self, observation: TargetObservation, target: Target) -> float:
        """The ratio of the size of what is at a target's place to the target's."""
        p, patch = self.params, log_polar_square(observation, target)
        shift = observation.k.log_polar_shift(
            patch, LOG_POLAR_PIXELS, TAPER, self.applied, MAX_SHIFT, MAX_TURN, p.size_change_penalty
        )
        return math.exp(shift * LOG_PER_CELL)

    def learn(self, observation: TargetObservation, target: Target, rate: float) -> "SizeExpert":
        """The expert with a target blended in."""
        learned, applied = self._learn(observation, target, rate, self.params.first_frame_weight)
        return self._replace(learned=learned, applied=applied)

    def _learn(
        self, observation: TargetObservation, target: Target, rate: float, first_frame_weight: float
    ) -> tuple[Filter, Spectra]:
        """The filter as it is learned, and the applied one."""
        numerator, denominator, applied = observation.k.learn_size_filter(
            log_polar_square(observation, target),
            LOG_POLAR_PIXELS,
            TAPER,
            LABEL,
            *self.learned,
            *self.first,
            rate,
            first_frame_weight,
            self.params.ridge,
        )
        return (numerator, denominator), applied


def log_polar_square(observation: TargetObservation, target: Target) -> Image:
    """(64, 64, 3) samples around a target, of which log-polar coordinates have angles downwards, log radii to
    the right.

    Radii are in halves of its width and height, so that its surround has the same share on all sides.
    """
    width, height = OUTER_RADIUS * target.width, OUTER_RADIUS * target.height
    square = np.array([[target.x - width / 2, target.y - height / 2, width, height]])
    patch: Image = observation.sample(square, PATCH_PIXELS)[0]
    return patch


def _log_polar_pixels() -> NDArray[np.int64]:
    """(64, 64) indices of the nearest pixels of a square patch.

    At small radii several samples share a pixel, which speaks for the size as it is: a new one is approached
    over a few frames. Bilinear samples, which find it at once, let the size wander on recorded video.
    """
    steps = (np.arange(PATCH_PIXELS) + 0.5) / PATCH_PIXELS
    radius = PATCH_PIXELS / 2 * (INNER_RADIUS / OUTER_RADIUS) ** (1 - steps)
    angle = 2 * math.pi * steps[:, None]
    x, y = (
        np.clip(np.floor(PATCH_PIXELS / 2 + radius * unit), 0, PATCH_PIXELS - 1)
        for unit in (np.cos(angle), np.sin(angle))
    )
    pixels: NDArray[np.int64] = (y * PATCH_PIXELS + x).astype(np.int64)
    return pixels


def _taper() -> Plane:
    """(32, 32), so that the cells fade out towards the least and the largest radius; angles have no ends."""
    profile = np.sin(np.pi * (np.arange(WINDOW_CELLS) + 0.5) / WINDOW_CELLS)
    return np.tile(profile, (WINDOW_CELLS, 1)).astype(np.float32)


LOG_POLAR_PIXELS = _log_polar_pixels()
TAPER = _taper()
LABEL = label_spectrum(LABEL_WIDTH)
