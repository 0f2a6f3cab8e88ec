# SPDX-License-Identifier: MIT
"""The initial target of the depth particle tracker: in a given box, or the most prominent person."""

import numpy as np
from numpy.typing import NDArray

from tricue.camera.box import Box
from tricue.errors import NoDepthInBoxError, TargetNotFoundError
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.objects import BORDER, Objects
from tricue.track.depth_objects.projection import back_project_box
from tricue.track.depth_particle.matching import TargetObject
from tricue.track.depth_particle.others import enlarge
from tricue.track.depth_particle.params import DepthParticleParams
from tricue.track.depth_particle.signature import Signature

MIN_BOX_IOU = 0.3  # of a given box with the object that it marks
MIN_OBJECT_IOU = 0.5  # from which on the object's own outline is used, since boxes are drawn by hand
MIN_FILL = 0.25  # of its box, by an object that a box marks; what surrounds the box's middle fills less


def find_people(objects: Objects, p: DepthParticleParams) -> NDArray[np.intp]:
    """Indices of the human candidates, by aspect ratio, size, and the share of their box that they fill.

    The largest come first. Candidates that fill too much of their box, but may do so because they are cut,
    come last.
    """
    width, height = objects.states[:, 3], objects.states[:, 4]
    aspect, filled = height / width, objects.area / (width * height)
    tall = (height >= p.human_height[0]) & (height <= p.human_height[1])
    wider = p.complete & ~objects.whole[:, 0]  # wider than the visible part
    upright = (aspect >= p.aspect[0]) & ((aspect <= p.aspect[1]) | wider)
    # A full rectangle's area may exceed width times height by rounding, so 1 admits all.
    slender, cut = (filled <= p.max_fill) | (p.max_fill == 1), objects.cut.any(axis=1)
    return np.concatenate([np.flatnonzero(tall & upright & each) for each in (slender, ~slender & cut)])


def initialize_on_person(objects: Objects, p: DepthParticleParams) -> TargetObject:
    """The largest human candidate; TargetNotFoundError without any."""
    people = find_people(objects, p)
    if len(people) == 0:
        empty = "" if len(objects.states) else f", nor anything else {_describe_range(p)}"
        raise TargetNotFoundError(
            f"box: expected (x, y, width, height), as nobody was found in this frame{empty}"
        )
    return TargetObject.from_object(objects, int(people[0]))


def initialize_in_box(box: Box, objects: Objects, fg: Foreground, p: DepthParticleParams) -> TargetObject:
    """The object that overlaps the given box most; if the overlap is smaller, the box at its depth.

    Without an object in the box, the depth is the median in the middle of the box; NoDepthInBoxError if there
    is none. If an object is cut, neither size is known, because the hidden part may be wider.
    """
    camera = fg.camera * fg.step
    fills = objects.area >= MIN_FILL * objects.states[:, 3] * objects.states[:, 4]
    outlines = objects.boxes(camera)
    overlaps = [box.iou(each) if fill else 0.0 for each, fill in zip(outlines, fills, strict=True)]
    best = int(np.argmax(overlaps)) if overlaps else -1
    on_object = best >= 0 and overlaps[best] > MIN_BOX_IOU
    if not on_object:
        state = back_project_box(box, _median_depth(fg, box, p), camera)
        return TargetObject(state, _whole(box, fg), Signature.uniform())
    outline = _within(outlines[best], box, fg.step) if overlaps[best] >= MIN_OBJECT_IOU else box
    state = back_project_box(outline, float(objects.states[best, 2]), camera)
    whole = np.full(2, (_whole(outline, fg) & objects.whole[best]).all())
    return TargetObject(state, whole, Signature.from_object(objects, best))


def _within(outline: Box, box: Box, step: int) -> Box:
    """An object's outline, replaced by the given box's sides where the object extends beyond the box."""
    region = enlarge(box).xyxy
    inward = [1, 1, -1, -1]
    sides = [
        given if sense * (own - edge) < step else own
        for own, given, edge, sense in zip(outline.xyxy, box.xyxy, region, inward, strict=True)
    ]
    return Box.from_xyxy(*sides)


def _whole(box: Box, fg: Foreground) -> NDArray[np.bool_]:
    """(2,) whether the box's width and height are inside the measured area."""
    first, last = np.reshape(fg.measured, (2, 2)) * fg.step
    box_first, box_last = np.reshape(box.xyxy, (2, 2))
    inside: NDArray[np.bool_] = (box_first >= first + BORDER) & (box_last <= last - BORDER)
    return inside


def _middle_half(start: float, length: float, step: int, size: int) -> slice:
    """The pixels in the middle half of an interval, inside the image, at least one."""
    first = int((start + length / 4) // step)
    last = max(first, int((start + 3 * length / 4) // step))
    return slice(min(max(first, 0), size - 1), max(last + 1, 1))


def _describe_range(p: DepthParticleParams) -> str:
    return f"above the floor and between near and far, {p.near:g} and {p.far:g} m"


def _median_depth(fg: Foreground, box: Box, p: DepthParticleParams) -> float:
    """The median depth in the middle of a box; NoDepthInBoxError if there is none."""
    height, width = fg.depth.shape
    columns = _middle_half(box.x, box.width, fg.step, width)
    middle = fg.depth[_middle_half(box.y, box.height, fg.step, height), columns]
    middle = middle[np.isfinite(middle)]
    if middle.size == 0:
        raise NoDepthInBoxError(
            f"box: expected a target with measured depth in its middle, {_describe_range(p)}, "
            f"got none in {tuple(box)}"
        )
    return float(np.median(middle))
