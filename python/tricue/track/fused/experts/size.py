# SPDX-License-Identifier: MIT
"""The target's size: in log-polar coordinates around its center a change of size is a shift."""

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

FARTHEST = 2, 1  # cells of radius and of angle, from one frame to the next


@dataclass(frozen=True, kw_only=True)
class SizeParams(LogPolarParams):
    """Of the cue "size"."""

    size_range: tuple[float, float] = parameter(
        (0.2, 5.0), unit="of the first size", source=OURS, above=0, doc="limits of the size"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.size_range[0] > self.size_range[1]:
            raise ValueError(f"size_range: expected the lower number first, got {self.size_range}")


class SizeExpert(NamedTuple):
    """A filter on log-polar coordinates, whose radii are in halves of the target's width and height, so that
    its surround has the same share on all sides.
    """

    filter: LogPolarFilter
    params: SizeParams

    @classmethod
    def from_target(cls, observation: TargetObservation, target: Target, p: SizeParams) -> "SizeExpert":
        """Learned from the first frame."""
        return cls(LogPolarFilter.from_patch(observation.k, *_read(observation, target), p), p)

    def growth(self, observation: TargetObservation, target: Target) -> float:
        """The ratio of the size found at a target's place to the target's."""
        patch, penalty = _read(observation, target), self.params.size_change_penalty
        shift, _ = self.filter.shift(observation.k, *patch, FARTHEST, penalty)
        return math.exp(LOG_PER_CELL * shift)

    def learn(self, observation: TargetObservation, target: Target, rate: float) -> "SizeExpert":
        """The expert with a target blended in."""
        patch = _read(observation, target)
        return self._replace(filter=self.filter.learn(observation.k, *patch, rate, self.params))


def _read(observation: TargetObservation, target: Target) -> tuple[Image, Coordinates]:
    """(64, 64, 3) samples around a target, and its coordinates in them, turned by whole cells of angle."""
    width, height = OUTER_RADIUS * target.width, OUTER_RADIUS * target.height
    turn = STEPS_PER_CELL * round(target.turn / STEPS_PER_CELL)
    if not turn:
        window = np.array([[target.x - width / 2, target.y - height / 2, width, height]])
        return observation.sample(window, PATCH_PIXELS)[0], UPRIGHT
    longer = max(width, height)
    window = np.array([[target.x - longer / 2, target.y - longer / 2, longer, longer]])
    shape = round(width / longer, 3), round(height / longer, 3)  # few of them, as they are kept
    return observation.sample(window, PATCH_PIXELS)[0], _turned(turn, *shape)


@lru_cache(maxsize=256)
def _turned(turn: int, width: float, height: float) -> Coordinates:
    return Coordinates(log_polar_pixels(turn, width, height), TAPER)


UPRIGHT = Coordinates(log_polar_pixels(), TAPER)
