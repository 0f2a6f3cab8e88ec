# SPDX-License-Identifier: MIT
"""The target as an object segmented in the depth image: a person or a thing that stands apart.

If the first box holds such an object and little else, the object is the target. The target's box is then the
object's, even when it turns, spreads its arms or is still entering the image. But the segments of neighboring
objects also merge, so an object that is suddenly much larger is ignored.
"""

from typing import NamedTuple

from tricue.arrays import Floats, Plane
from tricue.camera.box import Box, shared_area
from tricue.track.base.validation import ADDED_TIME_ERROR
from tricue.track.depth_objects.floor import NO_FLOOR
from tricue.track.depth_objects.foreground import Foreground, extract_foreground
from tricue.track.depth_objects.objects import EVERYWHERE, Region, segment
from tricue.track.depth_objects.params import SegmentationParams
from tricue.track.fused.depth_sources import DepthImageSource
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.target import Target

SEGMENTATION = SegmentationParams(resolution=240)  # finer is slower and splits bodies more often
MIN_FIRST_IOU = 0.7  # of the first box with an object's: 0.8 for people, 0.3 for things on a table
MIN_SIDE = 0.3  # meters, of the longer side: smaller things merge with the table or the hand that they touch
MIN_INSIDE = 0.5  # share of the target's own box that is inside the object's
MAX_DEPTH_OFFSET = 0.5  # meters, from the target's depth to its object's mean depth
MAX_GROWTH = 1.5  # of the width or height: a neighbor that merges with the object adds more
MAX_GROWTH_OF_PART = 2.0  # the same for an object that was partly hidden
MIN_RENEWED_GROWTH = 3.0  # of the area, above which the models know too little of the target
REGION = 2 * MAX_GROWTH_OF_PART  # size of the region searched for the object, relative to the target's box
SEARCH_INTERVAL = 0.2  # seconds between two searches: each takes half as long as all other steps of an update


class SeenObject(NamedTuple):
    """An object in one frame.

    box: of the visible part, pixels. z: mean depth. z, width, height: meters. is_whole: whether neither the
    image's border nor anything nearer hides a part of it.
    """

    box: Box
    z: float
    width: float
    height: float
    is_whole: bool

    @property
    def is_small(self) -> bool:
        """Whether the object is small; False if only a part is visible, as its size isn't known then."""
        return self.is_whole and max(self.width, self.height) < MIN_SIDE


class DepthObject(NamedTuple):
    """The state of the object that is the target.

    floor: (6,) the plane of the floor in the last search. first: the object when the models were made. width,
    height: meters, when last seen; if a part was hidden then, not less than before. is_whole: whether it was
    fully visible when last seen. was_whole: whether it was ever fully visible. seen: the object in this
    frame; None if it wasn't found or not searched for. growth: the larger ratio of width or height between
    the last two times that it was seen. seconds: since the last search.
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
    def from_first(cls, observation: PictureObservation, target: Target) -> "DepthObject | None":
        """The object in the first box; None without a depth image, or if no object fills the box, or a small
        one does.
        """
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
        """Whether it is time for the next search."""
        return self.seconds >= SEARCH_INTERVAL - ADDED_TIME_ERROR

    @property
    def outgrew_models(self) -> bool:
        """Whether the models were made from a small part of the object.

        Only an object that comes into sight gradually counts: one that was fully visible before, or grows
        suddenly, has merged with another.
        """
        grown = self.width * self.height > MIN_RENEWED_GROWTH * self.first.width * self.first.height
        return grown and not self.was_whole and self.growth <= MAX_GROWTH

    def wait(self, seconds: float) -> "DepthObject":
        """The object so many seconds later, without a search."""
        return self._replace(seen=None, seconds=self.seconds + seconds)

    def search(self, observation: PictureObservation, target: Target, around: Box, z: float) -> "DepthObject":
        """Search near depth z, in meters, for the object that contains most of the target's own box.

        around: the box around which objects are searched for, that of the whole target.
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
    observation: PictureObservation, depth: Plane, floor: Floats = NO_FLOOR, around: Box | None = None
) -> tuple[list[SeenObject], Floats]:
    """The objects in the frame's depth image, or only those around a box, and the plane (6,) of the floor.

    floor: its plane in an earlier frame. Sabeti, Parvizi and Wu 2008, section IV.A.
    """
    k, camera = observation.k, observation.camera.vector
    foreground, floor = extract_foreground(k, depth, camera, floor, 0, SEGMENTATION)
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
    """The part of the foreground that is searched for the object in a box: x0, y0, x1, y1."""
    (x, y), step = box.center, foreground.step
    reach_x, reach_y = REGION / 2 * box.width, REGION / 2 * box.height
    height, width = foreground.depth.shape
    left, right = (min(max(round(side / step), 0), width) for side in (x - reach_x, x + reach_x))
    top, bottom = (min(max(round(side / step), 0), height) for side in (y - reach_y, y + reach_y))
    return left, top, right, bottom


def _visible(box: Box, observation: PictureObservation) -> Box:
    height, width = observation.shape
    return box.clip(width, height)


def _share_inside(box: Box, other: Box) -> float:
    """The share of a box that is inside another; 0 for an empty box."""
    return shared_area(box, other) / box.area if box.area > 0 else 0.0
