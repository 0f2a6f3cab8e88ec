# SPDX-License-Identifier: MIT
"""The turn expert: in log-polar coordinates around the target's center, an in-plane rotation is a shift.

Turns are accumulated, and so are their errors: a walker's legs turn a little in every frame. So a turn is
reduced if the filter's response to it is weak, as in a Wiener filter. And as most targets are upright most of
the time, a small share of the turn is undone in every frame.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from tricue.track.base.params import parameter
from tricue.track.fused.arrays import Image
from tricue.track.fused.experts.log_polar import (
    OUTER_RADIUS,
    STEPS_PER_CELL,
    TAPER,
    Coordinates,
    LogPolarFilter,
    LogPolarParams,
    Places,
    log_polar_pixels,
)
from tricue.track.fused.sources import OURS
from tricue.track.fused.target import TURN_STEPS, Target
from tricue.track.fused.target_observation import TargetObservation
from tricue.track.fused.window import PATCH_PIXELS

STEPS_PER_PIXEL = TURN_STEPS // PATCH_PIXELS
FARTHEST = 2, 1  # cells of angle and of radius, between consecutive frames


@dataclass(frozen=True, kw_only=True)
class TurnParams(LogPolarParams):
    """The parameters of the cue "turn"."""

    turn_noise: float = parameter(
        0.1, unit="response", source=OURS, above=0, doc="response at which half of a turn counts"
    )
    turn_back: float = parameter(
        0.1,
        unit="per frame",
        source=OURS,
        low=0,
        high=1,
        doc="share of its turn, and of 11 degrees at most, by which a target turns back",
    )


class TurnExpert(NamedTuple):
    """A filter in log-polar coordinates of a square around the target, in which a turn is a pure shift."""

    filter: LogPolarFilter
    params: TurnParams

    @classmethod
    def from_target(cls, observation: TargetObservation, target: Target, p: TurnParams) -> "TurnExpert":
        """The expert learned from the first frame."""
        return cls(LogPolarFilter.from_patch(observation.k, *_read(observation, target), p), p)

    def turn(self, observation: TargetObservation, target: Target) -> float:
        """Steps by which to turn a target clockwise: the measured turn, minus the share that is undone."""
        p, patch = self.params, _read(observation, target)
        shift, response = self.filter.shift(observation.k, *patch, FARTHEST, p.size_change_penalty)
        power, noise = max(response, 0.0) ** 2, p.turn_noise**2
        back = p.turn_back * min(max(target.turn, -STEPS_PER_CELL), STEPS_PER_CELL)
        return STEPS_PER_CELL * shift * power / (power + noise) - back

    def learn(self, observation: TargetObservation, target: Target, rate: float) -> "TurnExpert":
        """The expert with a target blended in."""
        patch = _read(observation, target)
        return self._replace(filter=self.filter.learn(observation.k, *patch, rate, self.params))


def _read(observation: TargetObservation, target: Target) -> tuple[Image, Coordinates]:
    """(64, 64, 3) samples of a square around a target, and their coordinates."""
    side = OUTER_RADIUS * target.side
    square = np.array([[target.x - side / 2, target.y - side / 2, side, side]])
    return observation.sample(square, PATCH_PIXELS)[0], _angles_to_the_right(target.turn)


@lru_cache(maxsize=256)
def _angles_to_the_right(turn: int) -> Coordinates:
    first, step = divmod(turn % TURN_STEPS, STEPS_PER_PIXEL)
    return Coordinates(np.ascontiguousarray(_twice_round(step)[:, first : first + PATCH_PIXELS]), TAPER_DOWN)


@lru_cache(maxsize=STEPS_PER_PIXEL)
def _twice_round(step: int) -> Places:
    """(64, 128) all angles twice, so that a further turn by whole pixels is a slice of the array."""
    pixels = log_polar_pixels(step).T
    return np.concatenate([pixels, pixels], axis=1)


TAPER_DOWN = np.ascontiguousarray(TAPER.T)
