# SPDX-License-Identifier: MIT
"""The target as an object of the depth image: a person or a thing that stands apart.

If the first box holds such an object and little else, the target is that object and its box the object's,
however it turns, spreads its arms or comes into the image. But objects also merge. So an object that is
suddenly much larger is ignored.
"""

from typing import NamedTuple

import numpy as np

from tricue.camera.box import Box
from tricue.track.base.validation import ADDED_TIME_ERROR
from tricue.track.depth_objects.floor import NO_FLOOR
from tricue.track.depth_objects.foreground import Foreground, extract_foreground
from tricue.track.depth_objects.objects import EVERYWHERE, Region, segment
from tricue.track.depth_objects.params import SegmentationParams
from tricue.track.fused.arrays import Floats, Plane
from tricue.track.fused.depth_sources import DepthImageSource
from tricue.track.fused.target import Target
from tricue.track.fused.target_observation import TargetObservation

SEGMENTATION = SegmentationParams(resolution=240)  # finer, bodies fall apart more often, and it takes longer
MIN_FIRST_IOU = 0.7  # of the first box and an object's: people's have 0.8, of what stands on a table 0.3
MIN_SIDE = 0.3  # meters, the longer: smaller things can't be told from the table or the hand that they touch
MIN_INSIDE = 0.5  # of the target's own box, in that of its object
MAX_DEPTH_OFFSET = 0.5  # meters, from the target's depth to its object's mean depth
MAX_GROWTH = 1.5  # of the width or height: a neighbor that merges with it adds more
MAX_GROWTH_OF_PART = 2.0  # the same of an object of which a part was hidden
MIN_RENEWED_GROWTH = 3.0  # of the area, from which the models know too little of the target
REGION = 2 * MAX_GROWTH_OF_PART  # times the target's box: where its object is searched for
INTERVAL = 0.2  # seconds between two searches: each takes half as long as all other steps


class SeenObject(NamedTuple):
    """box: of the visible part, pixels. z: mean depth. z, width, height: meters. is_whole: whether neither
    the image's border nor anything nearer cuts it off.
    """

    box: Box
    z: float
    width: float
    height: float
    is_whole: bool

    @property
    def is_small(self) -> bool:
        """Whether all of it is small; unknown, so False, if only a part is visible."""
        return self.is_whole and max(self.width, self.height) < MIN_SIDE


class DepthObject(NamedTuple):
    """The state of the object that is the target.

    floor: (6,) the plane of the floor in the last search for objects. first: the object when the models were
    made. width, height: meters, when last seen; if a part was hidden then, at least those before. is_whole:
    whether nothing was hidden then; was_whole: whether ever. seen: in this frame; None if it wasn't found or
    wasn't searched for. growth: the larger one of its width and height, since it was seen before. seconds:
    since it was searched for.
    """

    floor: Floats
    first: SeenObject
    width: float
    height: float
    is_whole: bool
    was_whole: bool
    seen: SeenObject | None = None
    growth: float = 1.0
    seconds: float = 0.0

    @classmethod
    def from_first(cls, observation: TargetObservation, target: Target) -> "DepthObject | None":
        """The object in the first box; None if the box holds none, or more than that, or a small one."""
        source = observation.depth_source
        if not isinstance(source, DepthImageSource):
            return None
        objects, floor = find_objects(observation, source.depth)
        own = _visible(target.box, observation)
        best = max(objects, key=lambda each: own.iou(each.box), default=None)
        if best is None or own.iou(best.box) < MIN_FIRST_IOU or best.is_small:
            return None
        return cls(floor, best, best.width, best.height, best.is_whole, best.is_whole)

    @property
    def is_due(self) -> bool:
        """Whether it is time to search for it."""
        return self.seconds >= INTERVAL - ADDED_TIME_ERROR

    @property
    def outgrew_models(self) -> bool:
        """Whether the models were made of a small part of it.

        Only while it comes into sight gradually: an object that was wholly visible, or that grows suddenly,
        has merged with something else.
        """
        grown = self.width * self.height > MIN_RENEWED_GROWTH * self.first.width * self.first.height
        return grown and not self.was_whole and self.growth <= MAX_GROWTH

    def wait(self, seconds: float) -> "DepthObject":
        """The object after some seconds without a search."""
        return self._replace(seen=None, seconds=self.seconds + seconds)

    def look(self, observation: TargetObservation, target: Target, around: Box, z: float) -> "DepthObject":
        """Search for the object near depth z, in meters, that contains most of the target's own box.

        around: the whole target's box.
        """
        source = observation.depth_source
        assert isinstance(source, DepthImageSource), "the first object was found in a depth image"
        objects, floor = find_objects(observation, source.depth, self.floor, around)
        known = self._replace(floor=floor, seen=None, seconds=0.0)
        own = _visible(target.box, observation)
        near = [each for each in objects if abs(each.z - z) <= MAX_DEPTH_OFFSET]
        best = max(near, key=lambda each: _share_inside(own, each.box), default=None)
        if best is None or _share_inside(own, best.box) < MIN_INSIDE or known._is_too_large(best):
            return known
        return known._see(best)

    def _is_too_large(self, seen: SeenObject) -> bool:
        growth = MAX_GROWTH if self.is_whole else MAX_GROWTH_OF_PART
        width, height = max(self.width, self.first.width), max(self.height, self.first.height)
        return seen.width > growth * width or seen.height > growth * height

    def _see(self, seen: SeenObject) -> "DepthObject":
        width, height = seen.width, seen.height
        return self._replace(
            width=width if seen.is_whole else max(width, self.width),
            height=height if seen.is_whole else max(height, self.height),
            is_whole=seen.is_whole,
            was_whole=self.was_whole or seen.is_whole,
            seen=seen,
            growth=max(width / self.width, height / self.height),
        )


def find_objects(
    observation: TargetObservation, depth: Plane, floor: Floats = NO_FLOOR, around: Box | None = None
) -> tuple[list[SeenObject], Floats]:
    """The objects in the frame's depth image, all or those around a box, and the plane (6,) of the floor.

    floor: its plane in an earlier frame. Sabeti, Parvizi and Wu 2008, section IV.A.
    """
    k, camera, rng = observation.k, observation.camera.vector, np.random.default_rng(0)
    foreground, floor = extract_foreground(k, depth, camera, floor, rng, SEGMENTATION)
    region = EVERYWHERE if around is None else _region(around, foreground)
    found = segment(k, foreground, floor, SEGMENTATION, region=region)
    seen = [
        SeenObject(_visible(box, observation), z, width, height, whole == [True, True])
        for box, (_, _, z, width, height), whole in zip(
            found.boxes(camera), found.states.tolist(), found.whole.tolist(), strict=True
        )
    ]
    return seen, floor


def _region(box: Box, foreground: Foreground) -> Region:
    """The columns and rows of the foreground, x0, y0, x1, y1, in which the object in a box is."""
    (x, y), step = box.center, foreground.step
    reach_x, reach_y = REGION / 2 * box.width, REGION / 2 * box.height
    height, width = foreground.depth.shape
    left, right = (min(max(round(side / step), 0), width) for side in (x - reach_x, x + reach_x))
    top, bottom = (min(max(round(side / step), 0), height) for side in (y - reach_y, y + reach_y))
    return left, top, right, bottom


def _visible(box: Box, observation: TargetObservation) -> Box:
    height, width = observation.shape
    return box.clip(width, height)


def _share_inside(box: Box, other: Box) -> float:
    """The share of a box that is inside the other one; 0 for an empty box."""
    wide = min(box.x + box.width, other.x + other.width) - max(box.x, other.x)
    high = min(box.y + box.height, other.y + other.height) - max(box.y, other.y)
    return wide * high / box.area if min(wide, high, box.area) > 0 else 0.0
