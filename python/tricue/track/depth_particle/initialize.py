# SPDX-License-Identifier: MIT
"""On whom the depth particle tracker starts: on what is in a box, or on the most prominent person."""

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.errors import NoDepthInBoxError, TargetNotFoundError
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.metric import state_of
from tricue.track.depth_objects.objects import EDGE, Objects
from tricue.track.depth_particle.matching import Found
from tricue.track.depth_particle.params import DepthParticleParams
from tricue.track.depth_particle.signature import Signature

ALIKE = 0.3  # overlap of a box and the object that is meant by it


def humans(objects: Objects, p: DepthParticleParams) -> NDArray[np.intp]:
    """Indices of those that may be people, by aspect ratio, size, and how much of their box they fill.

    The largest come first; last come those that fill their box and may do so because it is cut.
    """
    width, height = objects.states[:, 3], objects.states[:, 4]
    aspect, filled = height / width, objects.area / (width * height)
    tall = (height >= p.human_height[0]) & (height <= p.human_height[1])
    upright = (aspect >= p.aspect[0]) & ((aspect <= p.aspect[1]) | ~objects.whole[:, 0])
    slender, cut = filled <= p.fill, objects.cut.any(axis=1)
    return np.concatenate([np.flatnonzero(tall & upright & each) for each in (slender, ~slender & cut)])


def somebody(objects: Objects, p: DepthParticleParams) -> Found:
    """The largest of the human candidates; ValueError where there is none."""
    people = humans(objects, p)
    if len(people) == 0:
        empty = "" if len(objects.states) else f", nor anything else {_in_range(p)}"
        raise TargetNotFoundError(
            f"box: expected (x, y, width, height), as nobody was found in this frame{empty}"
        )
    chosen = int(people[0])
    return Found(objects.states[chosen], objects.whole[chosen], Signature.of(objects, chosen))


def in_box(box: Box, objects: Objects, fg: Foreground, p: DepthParticleParams) -> Found:
    """The box itself, at the depth of the object that fills it best, or else of what is in its middle.

    ValueError where nothing is in its middle that can be followed.
    """
    camera = fg.camera * fg.step
    overlaps = [box.iou(each) for each in objects.boxes(camera)]
    best = int(np.argmax(overlaps)) if overlaps else -1
    meant = best >= 0 and overlaps[best] > ALIKE
    z = float(objects.states[best, 2]) if meant else _middle_depth(fg, box, p)
    return Found(
        state_of(box, z, camera),
        _whole(box, fg),
        Signature.of(objects, best) if meant else Signature.unknown(),
    )


def _whole(box: Box, fg: Foreground) -> NDArray[np.bool_]:
    height, width = np.multiply(fg.depth.shape, fg.step)
    left, top, right, bottom = box.xyxy
    return np.array(
        [left >= EDGE and right <= width - EDGE, top >= EDGE and bottom <= height - EDGE], np.bool_
    )


def _middle(start: float, length: float, step: int, size: int) -> slice:
    """The pixels in the middle half of an interval, at least one, as far as they are in the image."""
    first = int((start + length / 4) // step)
    last = max(first, int((start + 3 * length / 4) // step))
    return slice(min(max(first, 0), size - 1), max(min(last + 1, size), 1))


def _in_range(p: DepthParticleParams) -> str:
    return f"above the floor and between near and far, {p.near:g} and {p.far:g} m"


def _middle_depth(fg: Foreground, box: Box, p: DepthParticleParams) -> float:
    """The median depth in the middle of a box; ValueError where nothing there has one."""
    height, width = fg.depth.shape
    columns = _middle(box.x, box.width, fg.step, width)
    middle = fg.depth[_middle(box.y, box.height, fg.step, height), columns]
    middle = middle[np.isfinite(middle)]
    if middle.size == 0:
        raise NoDepthInBoxError(
            f"box: expected a target with measured depth in its middle, {_in_range(p)}, "
            f"got none in {tuple(box)}"
        )
    return float(np.median(middle))
