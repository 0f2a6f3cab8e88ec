# SPDX-License-Identifier: MIT
"""Finds the target's object by predicted position, size and signature, and completes its body."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.kernels import Kernels
from tricue.track.depth_objects.objects import Objects
from tricue.track.depth_particle.motion import BodyMotion
from tricue.track.depth_particle.signature import Signature

# Standard deviations of the target's object from the predicted state.
POSITION_DEVIATION = (0.15, 0.35, 0.15)  # meters of X, Y, Z, plus
POSITION_DEVIATION_RATE = (0.45, 0.2, 0.45)  # meters per second since the target was seen
SIZE_DEVIATION = (0.2, 0.05)  # of the size, plus meters

UNKNOWN_CENTER_WEIGHT = 0.5  # of the position, along an axis where the size is only a lower bound
LARGER_SIZE_WEIGHT = 0.3  # of a size that exceeds such a lower bound
UNKNOWN_WEIGHTS = UNKNOWN_CENTER_WEIGHT, LARGER_SIZE_WEIGHT
SIGNATURE_COST = 3.0  # nats, of the most different signature
NO_COSTS = np.empty(0)

PIECE_REGION = 1.3  # times the expected rectangle, the region in which pieces of the body are looked for
MIN_PIECE_INSIDE = 0.8  # of a piece's area, in that region
MAX_JOINED_SIZE = 1.15  # times the mean size, for a body with its pieces
MAX_PIECE_DEPTH = 0.4  # meters from the body's depth to that of a stretched arm or leg
PIECES = PIECE_REGION, MIN_PIECE_INSIDE, MAX_JOINED_SIZE, MAX_PIECE_DEPTH


class MatchLimits(NamedTuple):
    """What an object needs to be the target.

    max_cost: its cost is below this, nats. min_area_share: it shows at least this share of the target's area.
    """

    max_cost: float
    min_area_share: float


FOLLOWED, MISSED = MatchLimits(8.0, 0.25), MatchLimits(2.0, 0.45)  # stricter after a miss


class TargetObject(NamedTuple):
    """The target's object.

    state: (5,) completed where it is cut. whole: (2,) whether the full width and the full height are visible.
    """

    state: Floats
    whole: NDArray[np.bool_]
    signature: Signature

    @classmethod
    def from_object(cls, objects: Objects, index: int) -> "TargetObject":
        """An object as it is."""
        whole = objects.whole[index]
        return cls(objects.states[index], whole, Signature.from_object(objects, index))


def best_match(
    k: Kernels,
    objects: Objects,
    expected: Floats,
    motion: BodyMotion,
    signature: Signature,
    seconds: float,
    limits: MatchLimits,
    *,
    complete: bool = True,
    other_costs: Floats = NO_COSTS,
) -> int | None:
    """The index of the object with the lowest cost relative to the expected state (5,), within the limits.

    The cost, in nats, is that of position, size and signature, plus ``other_costs`` (C,) of each object.
    complete: whether objects are compared after completing them where they are cut. seconds: since the target
    was seen.
    """
    (x, y, z), (x_rate, y_rate, z_rate) = POSITION_DEVIATION, POSITION_DEVIATION_RATE
    deviation = x + x_rate * seconds, y + y_rate * seconds, z + z_rate * seconds, *SIZE_DEVIATION
    width, height = motion.mean_size.tolist()
    min_area = limits.min_area_share * width * height
    costs = deviation, UNKNOWN_WEIGHTS, SIGNATURE_COST, limits.max_cost, min_area
    body = expected, motion.mean_size, motion.size_known
    index = k.match_object(objects, other_costs, body, signature.values, costs, complete)
    return None if index < 0 else index


def complete_body(
    k: Kernels, objects: Objects, index: int, expected: Floats, motion: BodyMotion
) -> tuple[TargetObject, BodyMotion]:
    """The body that an object belongs to, expected at a state (5,): joined with pieces, such as arms and
    legs, that gaps separate from it, and completed where it is cut.

    Also returns the motion, whose mean size grows where it is a lower bound.
    """
    body = expected, motion.mean_size, motion.size_known
    state, whole, size, signature = k.complete_body(objects, index, body, PIECES)
    grown = motion if all(motion.size_known.tolist()) else motion._replace(mean_size=size)
    return TargetObject(state, whole, Signature(signature)), grown
