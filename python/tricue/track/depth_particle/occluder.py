# SPDX-License-Identifier: MIT
"""The object that hides the target: found when the target is missed, followed until it is seen again."""

import numpy as np

from tricue.arrays import Floats
from tricue.track.depth_objects.objects import Objects

OCCLUDER_RADIUS = 0.5  # horizontal meters around an occluder within which objects count as its pieces
HEIGHT_WEIGHTS = np.array([1.0, 0.3, 1.0])  # of X, Y, Z in distances; the height changes with what is cut
MIN_OCCLUDER_STEP = 0.3  # meters that an occluder may move between any two frames


def find_occluder(objects: Objects, expected: Floats, margin: float) -> int | None:
    """The index of the object that covers most of the expected rectangle, state (5,), if there is one.

    It must be nearer than the rectangle by more than the margin, meters.
    """
    if len(objects.states) == 0:
        return None
    in_front = objects.states[:, 2] < expected[2] - margin
    # As the camera sees them: projected to the depth of 1 m.
    centers, sizes = (objects.states[:, each] / objects.states[:, 2:3] for each in (slice(0, 2), slice(3, 5)))
    center, size = expected[:2] / expected[2], expected[3:] / expected[2]
    low = np.maximum(centers - sizes / 2, center - size / 2)
    high = np.minimum(centers + sizes / 2, center + size / 2)
    covered = np.prod(np.maximum(high - low, 0), axis=1) * in_front
    best = int(np.argmax(covered))
    return best if covered[best] > 0 else None


def follow_occluder(objects: Objects, position: Floats, max_speed: float, seconds: float) -> int | None:
    """The index of the object nearest the occluder's last position (3,), meters, if within reach.

    max_speed: m/s. seconds: since the last frame.
    """
    if len(objects.states) == 0:
        return None
    distances = np.linalg.norm((objects.states[:, :3] - position) * HEIGHT_WEIGHTS, axis=1)
    best = int(np.argmin(distances))
    return best if distances[best] < MIN_OCCLUDER_STEP + max_speed * seconds else None


def remove_occluder(objects: Objects, position: Floats) -> Objects:
    """The objects without the occluder at a position (3,), meters, and its pieces."""
    distances = np.linalg.norm(objects.states[:, [0, 2]] - position[[0, 2]], axis=1)
    return Objects(*(each[distances > OCCLUDER_RADIUS] for each in objects))
