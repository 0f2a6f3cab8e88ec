# SPDX-License-Identifier: MIT
"""The size expert: in log-polar coordinates around the target's center, a change of size is a shift."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from tricue.track.base.params import parameter
from tricue.track.fused.experts.log_polar import (
    LOG_PER_CELL,
    OUTER_RADIUS,
    STEPS_PER_CELL,
    TAPER,
    LogPolarExpert,
    LogPolarParams,
    LogPolarPatch,
    Places,
    log_polar_pixels,
)
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.sources import PROTOTYPE
from tricue.track.fused.target import Target
from tricue.track.fused.window import PATCH_PIXELS


@dataclass(frozen=True, kw_only=True)
class SizeParams(LogPolarParams):
    """The parameters of the cue "size"."""

    size_range: tuple[float, float] = parameter(
        (0.2, 5.0), unit="of the first size", source=PROTOTYPE, above=0, doc="limits of the size"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.size_range[0] > self.size_range[1]:
            raise ValueError(f"size_range: expected the lower number first, got {self.size_range}")


class SizeExpert(LogPolarExpert[SizeParams]):
    """A filter in log-polar coordinates.

    Radii are relative to the target's width and height, so that the surround has the same share on all sides.
    Turns are rounded to whole cells of angle.
    """

    def growth(self, observation: PictureObservation, target: Target) -> float:
        """The ratio of the size that is measured at a target's place to the target's size."""
        shift, _ = self._shift(observation, target)
        return math.exp(LOG_PER_CELL * shift)

    @staticmethod
    def _read(observation: PictureObservation, target: Target) -> LogPolarPatch:
        width, height = OUTER_RADIUS * target.width, OUTER_RADIUS * target.height
        turn = STEPS_PER_CELL * round(target.turn / STEPS_PER_CELL)
        if not turn:
            window = np.array([[target.x - width / 2, target.y - height / 2, width, height]])
            return LogPolarPatch(observation.sample(window, PATCH_PIXELS)[0], UPRIGHT, TAPER)
        longer = max(width, height)
        window = np.array([[target.x - longer / 2, target.y - longer / 2, longer, longer]])
        shape = round(width / longer, 3), round(height / longer, 3)  # rounded, as places are cached by shape
        return LogPolarPatch(observation.sample(window, PATCH_PIXELS)[0], _turned(turn, *shape), TAPER)


@lru_cache(maxsize=256)
def _turned(turn: int, width: float, height: float) -> Places:
    return log_polar_pixels(turn, width, height)


UPRIGHT = log_polar_pixels()
