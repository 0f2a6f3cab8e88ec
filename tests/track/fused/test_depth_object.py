# SPDX-License-Identifier: MIT
"""The target as an object of the depth image, against depth images that are drawn."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
from tricue import Box, Frame, FusedTracker, Intrinsics, Status, Track
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_object import (
    MAX_DEPTH_OFFSET,
    MAX_GROWTH,
    MAX_GROWTH_OF_PART,
    MIN_FIRST_IOU,
    MIN_SIDE,
    SEARCH_INTERVAL,
    DepthObject,
    _share_inside,
    find_objects,
)
from tricue.track.fused.depth_sources import DepthImageSource
from tricue.track.fused.outline import BOX_OUTLINE, Outline
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.target import Target

WIDTH, HEIGHT, FOCAL, Z, WALL = 320, 240, 300.0, 2.0, 5.0
CAMERA = Intrinsics(FOCAL, FOCAL, WIDTH / 2 - 0.5, HEIGHT / 2 - 0.5, WIDTH, HEIGHT)
TEXTURE = np.random.default_rng(0).integers(0, 256, (48, 24, 3), np.uint8)
ROOM = np.random.default_rng(1).integers(90, 140, (HEIGHT, WIDTH, 3), np.uint8)
PIXEL_TOLERANCE = 2.0  # of the sides of an object in an image of one step a pixel

Rectangle = tuple[int, int, int, int]  # left, top, right, bottom, pixels
PERSON: Rectangle = (130, 60, 180, 200)  # 0.33 m by 0.93 m


def depth_of(*things: tuple[Rectangle, float]) -> np.ndarray:
    """A depth image of rectangles before a wall; the later ones in front."""
    depth = np.full((HEIGHT, WIDTH), WALL, np.float32)
    for (left, top, right, bottom), z in things:
        depth[max(top, 0) : max(bottom, 0), max(left, 0) : max(right, 0)] = z
    return depth


def observe(depth: np.ndarray) -> PictureObservation:
    """The target's frame with that depth."""
    return PictureObservation(kernel_sets.load("native"), ROOM, CAMERA, DepthImageSource(depth), None)


def target_of(rectangle: Rectangle) -> Target:
    """The target whose box is that rectangle."""
    return Target.of(Box.from_xyxy(*rectangle))


def first(rectangle: Rectangle = PERSON, box: Rectangle | None = None) -> DepthObject | None:
    """The object that is known after a first frame with a rectangle."""
    return DepthObject.from_first(observe(depth_of((rectangle, Z))), target_of(box or rectangle))


def look(known: DepthObject, *things: tuple[Rectangle, float], own: Rectangle = PERSON) -> DepthObject:
    """Looked for around the target's own box."""
    target = target_of(own)
    return known.search(observe(depth_of(*things)), target, target.box, Z)


def near(box: Box, rectangle: Rectangle) -> bool:
    """Whether a box is the rectangle but for rounding."""
    return bool(np.abs(np.subtract(box.xyxy, rectangle)).max() <= PIXEL_TOLERANCE)


class TestFirst:
    def test_a_box_around_a_person(self):
        known = first()
        assert known is not None
        assert known.is_whole
        assert known.was_whole
        assert known.width == pytest.approx(50 * Z / FOCAL, abs=PIXEL_TOLERANCE * Z / FOCAL)
        assert known.height == pytest.approx(140 * Z / FOCAL, abs=PIXEL_TOLERANCE * Z / FOCAL)
        assert near(known.first.box, PERSON)

    def test_a_part_of_a_person_is_not_the_person(self):
        face = (145, 60, 165, 85)
        assert Box.from_xyxy(*face).iou(Box.from_xyxy(*PERSON)) < MIN_FIRST_IOU
        assert first(box=face) is None

    def test_a_small_thing_is_not_told_from_what_it_touches(self):
        side = int(MIN_SIDE * FOCAL / Z)
        assert first((140, 100, 136 + side, 96 + side)) is None
        assert first((140, 100, 144 + side, 104 + side)) is not None

    def test_nothing_there(self):
        assert DepthObject.from_first(observe(depth_of()), target_of(PERSON)) is None

    def test_a_frame_of_color(self):
        observation = observe(depth_of((PERSON, Z)))._replace(depth_source=None)
        assert DepthObject.from_first(observation, target_of(PERSON)) is None

    def test_cut_by_the_border(self):
        known = first((130, 120, 180, HEIGHT))
        assert known is not None
        assert not known.is_whole
        assert not known.was_whole


class TestLook:
    @pytest.mark.parametrize("moved", [PERSON, (140, 60, 190, 200), (120, 60, 185, 200), (130, 90, 180, 200)])
    def test_its_box_is_that_of_the_object(self, moved):
        found = look(first(), (moved, Z))
        assert found.seen is not None
        assert near(found.seen.box, moved)

    def test_a_neighbor_that_joins_it_is_left_out(self):
        wide = (130, 60, 130 + int(50 * MAX_GROWTH) + 10, 200)
        known = first()
        found = look(known, (wide, Z))
        assert found.seen is None
        assert (found.width, found.height) == (known.width, known.height)

    def test_after_the_neighbor_has_left_it_is_found_again(self):
        found = look(look(first(), ((130, 60, 230, 200), Z)), (PERSON, Z))
        assert found.seen is not None
        assert near(found.seen.box, PERSON)

    def test_hidden_in_part_it_may_grow_back(self):
        """A look at what a neighbor leaves of it doesn't keep it small."""
        known = look(first(), ((130, 60, 180, 140), Z))
        assert known.seen is not None
        assert known.height < 0.93 / MAX_GROWTH
        found = look(known, (PERSON, Z))
        assert found.seen is not None
        assert near(found.seen.box, PERSON)

    def test_leaving_the_image_it_does_not_shrink(self):
        known = first()
        found = look(known, ((-30, 60, 20, 200), Z), own=(-30, 60, 20, 200))
        assert found.seen is not None
        assert near(found.seen.box, (0, 60, 20, 200))
        assert not found.is_whole
        assert found.width == known.width

    def test_a_part_may_grow_more(self):
        known = first((130, 200, 180, HEIGHT))
        grown = (130, HEIGHT - int(40 * (MAX_GROWTH_OF_PART - 0.1)), 180, HEIGHT)
        assert look(known, (grown, Z), own=(130, 200, 180, HEIGHT)).seen is not None
        grown = (130, HEIGHT - int(40 * (MAX_GROWTH_OF_PART + 0.2)), 180, HEIGHT)
        assert look(known, (grown, Z), own=(130, 200, 180, HEIGHT)).seen is None

    def test_elsewhere_or_at_another_depth_it_is_something_else(self):
        assert look(first(), ((200, 60, 250, 200), Z)).seen is None
        assert look(first(), (PERSON, Z - MAX_DEPTH_OFFSET - 0.1)).seen is None

    def test_the_object_is_the_one_that_most_of_the_target_is_in(self):
        beside = (182, 60, 230, 200), Z + 0.3
        found = look(first(), beside, (PERSON, Z))
        assert found.seen is not None
        assert near(found.seen.box, PERSON)


class TestOutgrown:
    def test_what_comes_into_the_image_bit_by_bit(self):
        tops = (200, 180, 152, 118)
        known = first((130, tops[0], 180, HEIGHT))
        outgrown = []
        for top in tops[1:]:
            part = (130, top, 180, HEIGHT)
            known = look(known, (part, Z), own=part)
            outgrown.append(known.outgrew_models)
        assert outgrown == [False, False, True]

    def test_not_at_once(self):
        known = first((130, 200, 180, HEIGHT))
        both = (130, 165, 225, HEIGHT)
        known = look(known, (both, Z), own=(130, 200, 180, HEIGHT))
        assert known.seen is not None
        assert known.growth > MAX_GROWTH
        assert not known._replace(width=10.0).outgrew_models

    def test_not_what_was_wholly_visible(self):
        known = first()
        assert not known._replace(width=10.0).outgrew_models


def test_the_interval_between_two_looks():
    """It is over after some frames."""
    known = first().wait(0.6 * SEARCH_INTERVAL)
    assert not known.is_due
    assert known.wait(0.4 * SEARCH_INTERVAL).is_due


def test_find_objects_around_a_box_finds_only_those():
    """Of two, the other is too far off."""
    observation = observe(depth_of((PERSON, Z), ((10, 60, 40, 200), 3.0)))
    source = observation.depth_source
    assert isinstance(source, DepthImageSource)
    everywhere, floor = find_objects(observation, source.depth)
    near_by, _ = find_objects(observation, source.depth, floor, Box.from_xyxy(145, 100, 165, 160))
    boxes = [each.box for each in everywhere]
    assert any(near(box, PERSON) for box in boxes)
    assert any(near(box, (10, 60, 40, 200)) for box in boxes)
    assert not any(box.x < 100 for box in (each.box for each in near_by))


@pytest.mark.parametrize(
    ("box", "share"),
    [((0, 0, 10, 10), 0.25), ((5, 5, 2, 2), 1.0), ((20, 0, 5, 5), 0.0), ((7, 7, 0, 0), 0.0)],
)
def test_share_inside(box, share):
    """Boxes partly, wholly and not inside, and an empty one."""
    assert _share_inside(Box(*box), Box(5, 5, 10, 10)) == share


def test_the_outline_of_a_box_gives_that_box():
    """Of any box, whatever the target's own."""
    target, box = Target(50.0, 60.0, 20.0, 40.0), Box(45.0, 35.0, 30.0, 50.0)
    assert Outline.of(box, target).apply_to(target).box == pytest.approx(box)
    assert Outline.of(target.box, target) == BOX_OUTLINE


def frame(rectangle: Rectangle, seconds: float, z: float = Z, depth: bool = True) -> Frame:
    """A textured target before a wall. No two depth images are the same, as those of a camera."""
    left, top, right, bottom = rectangle
    rows = np.arange(top, bottom)[:, None] - bottom, np.arange(left, right)[None] - left
    color = ROOM.copy()
    inside = TEXTURE[rows[0] // 6 % 48, rows[1] // 6 % 24]
    color[max(top, 0) : bottom, left:right] = inside[max(-top, 0) :]
    image = depth_of((rectangle, z)) + np.float32(1e-5 * seconds)
    return Frame(color, depth=image if depth else None, timestamp=seconds)


def follow(tracker: FusedTracker, rectangles: list[Rectangle], **changes: object) -> list[Track]:
    """From the second on, each frame when the object is looked for again."""
    return [
        tracker.update(frame(each, SEARCH_INTERVAL * (i + 1), **changes)) for i, each in enumerate(rectangles)
    ]


def started(rectangle: Rectangle = PERSON) -> FusedTracker:
    """A tracker after its first frame."""
    tracker = FusedTracker(intrinsics=CAMERA)
    tracker.init(frame(rectangle, 0.0), Box.from_xyxy(*rectangle))
    return tracker


class TestTracker:
    def test_the_box_follows_arms_that_are_spread(self):
        spread = [(130 - i, 60, 180 + i, 200) for i in range(1, 12)]
        tracks = follow(started(), spread)
        assert all(track.status is Status.TRACKED for track in tracks)
        assert all(near(track.box, each) for track, each in zip(tracks, spread, strict=True))

    def test_a_target_that_comes_into_the_image_is_learned_anew(self):
        """The camera tilts down: of what showed its upper end, three times as much is seen."""
        tops = range(192, 100, -6)
        tracker = started((130, 198, 180, HEIGHT))
        own = tracker._state.first_side
        tracks = follow(tracker, [(130, top, 180, HEIGHT) for top in tops])
        assert all(track.status is Status.TRACKED for track in tracks)
        assert near(tracks[-1].box, (130, tops[-1], 180, HEIGHT))
        assert tracker._state.first_side > 1.5 * own
        assert np.isfinite(tracks[-1].position).all()

    def test_frames_without_depth_in_between(self):
        tracker = started()
        tracks = follow(tracker, 3 * [PERSON], depth=False)
        assert all(near(track.box, PERSON) for track in tracks)
        wide = (122, 60, 188, 200)
        track = tracker.update(frame(wide, 4 * SEARCH_INTERVAL))
        assert near(track.box, wide)

    def test_depth_that_the_camera_repeats(self):
        """It is of a moment ago, and the target elsewhere by now."""
        tracker = started()
        old = depth_of((PERSON, Z))
        moving = [(130 + 4 * i, 60, 180 + 4 * i, 200) for i in range(1, 6)]
        tracks = [
            tracker.update(replace(frame(each, SEARCH_INTERVAL * (i + 1)), depth=old))
            for i, each in enumerate(moving)
        ]
        assert tracks[-1].box.iou(Box.from_xyxy(*moving[-1])) > 0.8

    @pytest.mark.parametrize("timed", [False, True])
    def test_frames_without_times_are_all_looked_at(self, timed):
        tracker = started()
        wide = frame((130, 60, 190, 200), SEARCH_INTERVAL / 2)
        track = tracker.update(wide if timed else replace(wide, timestamp=None))
        assert near(track.box, PERSON if timed else (130, 60, 190, 200))

    def test_depth_that_comes_later(self):
        tracker = FusedTracker(intrinsics=CAMERA)
        tracker.init(frame(PERSON, 0.0, depth=False), Box.from_xyxy(*PERSON))
        assert tracker._state.depth_object is None
        wide = (120, 60, 190, 200)
        tracks = follow(tracker, [PERSON, wide, wide])
        assert near(tracks[-1].box, wide)

    def test_a_pickled_tracker_goes_on_alike(self):
        tracker = started()
        follow(tracker, [PERSON])
        copy = pickle.loads(pickle.dumps(tracker))
        last = frame((124, 60, 186, 200), 2 * SEARCH_INTERVAL)
        assert tracker.update(last).box == copy.update(last).box
