# SPDX-License-Identifier: MIT
"""The turn expert: in log-polar coordinates around the target's center, an in-plane rotation is a shift.

Turns are accumulated, and so are their errors: a walker's legs turn a little in every frame. So a turn is
reduced if the filter's response to it is weak, as in a Wiener filter. And as most targets are upright most of
the time, a small share of the turn is undone in every frame.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from tricue.track.base.params import parameter
from tricue.track.fused.experts.log_polar import (
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
from tricue.track.fused.target import TURN_STEPS, Target
from tricue.track.fused.window import PATCH_PIXELS

STEPS_PER_PIXEL = TURN_STEPS // PATCH_PIXELS


@dataclass(frozen=True, kw_only=True)
class TurnParams(LogPolarParams):
    """The parameters of the cue "turn"."""

    turn_noise: float = parameter(
        0.1, unit="response", source=PROTOTYPE, above=0, doc="response at which half of a turn counts"
    )
    turn_back: float = parameter(
        0.1,
        unit="per frame",
        source=PROTOTYPE,
        low=0,
        high=1,
        doc="share of its turn, and of 11 degrees at most, by which a target turns back",
    )


class TurnExpert(LogPolarExpert[TurnParams]):
    """A filter in log-polar coordinates of a square around the target, in which a turn is a pure shift."""

    def turn(self, observation: PictureObservation, target: Target) -> float:
        """Steps by which to turn a target clockwise: the measured turn, minus the share that is undone."""
        p, (shift, response) = self.params, self._shift(observation, target)
        power, noise = max(response, 0.0) ** 2, p.turn_noise**2
        back = p.turn_back * min(max(target.turn, -STEPS_PER_CELL), STEPS_PER_CELL)
        return STEPS_PER_CELL * shift * power / (power + noise) - back

    @staticmethod
    def _read(observation: PictureObservation, target: Target) -> LogPolarPatch:
        side = OUTER_RADIUS * target.side
        square = np.array([[target.x - side / 2, target.y - side / 2, side, side]])
        samples = observation.sample(square, PATCH_PIXELS)[0]
        return LogPolarPatch(samples, _angles_to_the_right(target.turn), TAPER_DOWN)


@lru_cache(maxsize=256)
def _angles_to_the_right(turn: int) -> Places:
    first, step = divmod(turn % TURN_STEPS, STEPS_PER_PIXEL)
    return np.ascontiguousarray(_twice_round(step)[:, first : first + PATCH_PIXELS])


@lru_cache(maxsize=STEPS_PER_PIXEL)
def _twice_round(step: int) -> Places:
    """(64, 128) all angles twice, so that a further turn by whole pixels is a slice of the array."""
    pixels = log_polar_pixels(step).T
    return np.concatenate([pixels, pixels], axis=1)


TAPER_DOWN = np.ascontiguousarray(TAPER.T)
