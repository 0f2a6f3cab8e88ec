# SPDX-License-Identifier: MIT
"""The size expert: in log-polar coordinates around the target's center, a change of size is a shift."""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from tricue.track.base.params import parameter
from tricue.track.fused.arrays import Image
from tricue.track.fused.experts.log_polar import (
    LOG_PER_CELL,
    OUTER_RADIUS,
    STEPS_PER_CELL,
    TAPER,
    Coordinates,
    LogPolarFilter,
    LogPolarParams,
    log_polar_pixels,
)
from tricue.track.fused.sources import OURS
from tricue.track.fused.target import Target
from tricue.track.fused.target_observation import TargetObservation
from tricue.track.fused.window import PATCH_PIXELS

FARTHEST = 2, 1  # cells of radius and of angle, between consecutive frames


@dataclass(frozen=True, kw_only=True)
class SizeParams(LogPolarParams):
    """The parameters of the cue "size"."""

    size_range: tuple[float, float] = parameter(
        (0.2, 5.0), unit="of the first size", source=OURS, above=0, doc="limits of the size"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.size_range[0] > self.size_range[1]:
            raise ValueError(f"size_range: expected the lower number first, got {self.size_range}")


class SizeExpert(NamedTuple):
    """A filter in log-polar coordinates.

    Radii are relative to the target's width and height, so that the surround has the same share on all sides.
    """

    filter: LogPolarFilter
    params: SizeParams

    @classmethod
    def from_target(cls, observation: TargetObservation, target: Target, p: SizeParams) -> "SizeExpert":
        """The expert learned from the first frame."""
        return cls(LogPolarFilter.from_patch(observation.k, *_read(observation, target), p), p)

    def growth(self, observation: TargetObservation, target: Target) -> float:
        """The ratio of the size that is measured at a target's place to the target's size."""
        patch, penalty = _read(observation, target), self.params.size_change_penalty
        shift, _ = self.filter.shift(observation.k, *patch, FARTHEST, penalty)
        return math.exp(LOG_PER_CELL * shift)

    def learn(self, observation: TargetObservation, target: Target, rate: float) -> "SizeExpert":
        """The expert with a target blended in."""
        patch = _read(observation, target)
        return self._replace(filter=self.filter.learn(observation.k, *patch, rate, self.params))


def _read(observation: TargetObservation, target: Target) -> tuple[Image, Coordinates]:
    """(64, 64, 3) samples around a target, and their coordinates; turns are rounded to whole cells."""
    width, height = OUTER_RADIUS * target.width, OUTER_RADIUS * target.height
    turn = STEPS_PER_CELL * round(target.turn / STEPS_PER_CELL)
    if not turn:
        window = np.array([[target.x - width / 2, target.y - height / 2, width, height]])
        return observation.sample(window, PATCH_PIXELS)[0], UPRIGHT
    longer = max(width, height)
    window = np.array([[target.x - longer / 2, target.y - longer / 2, longer, longer]])
    shape = round(width / longer, 3), round(height / longer, 3)  # rounded, as coordinates are cached by shape
    return observation.sample(window, PATCH_PIXELS)[0], _turned(turn, *shape)


@lru_cache(maxsize=256)
def _turned(turn: int, width: float, height: float) -> Coordinates:
    return Coordinates(log_polar_pixels(turn, width, height), TAPER)


UPRIGHT = Coordinates(log_polar_pixels(), TAPER)
