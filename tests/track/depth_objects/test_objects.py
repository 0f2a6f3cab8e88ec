# SPDX-License-Identifier: MIT
"""The objects that a depth image is divided into, against drawn boxes of known size and place, and which of
them may be a person.
"""

import math

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, DepthParticleTracker, Intrinsics, reference
from tricue.errors import TargetNotFoundError
from tricue.track.depth_objects.floor import NO_FLOOR
from tricue.track.depth_objects.foreground import Foreground, extract_foreground
from tricue.track.depth_objects.objects import DISTRIBUTION_BINS, segment
from tricue.track.depth_objects.projection import project_box
from tricue.track.depth_particle.initialize import find_people, initialize_in_box, initialize_on_person
from tricue.track.depth_particle.others import region_in

Params = DepthParticleTracker.Params
P = Params()
CAMERA = Intrinsics.from_fov(176, 144, 47.5, 39.5)
NUMBERS = CAMERA.vector
NEARER, FARTHER, WALL = 2.0, 4.0, 7.0  # meters
LEFT_BOX, RIGHT_BOX = Box(30, 30, 36, 100), Box(110, 50, 20, 60)  # pixels


def drawn(*boxes: tuple[Box, float], wall: float = WALL, shape: tuple[int, int] = (144, 176)) -> Foreground:
    """Flat boxes at their depths, before a wall."""
    depth = np.full(shape, wall, np.float32)
    for box, z in boxes:
        left, top, right, bottom = map(int, box.xyxy)
        depth[max(0, top) : max(0, bottom), max(0, left) : max(0, right)] = z
    return extract_foreground(reference, depth, NUMBERS, NO_FLOOR, 0, Params(floor=False, gap_passes=0))[0]


def metric(box: Box, z: float) -> NDArray[np.float64]:
    """(5,) X, Y, Z, width and height of a flat box, by the camera model."""
    x, y = box.center
    place = CAMERA.back_project(x - 0.5, y - 0.5, z)
    return np.array([*place, box.width * z / CAMERA.fx, box.height * z / CAMERA.fy])


TWO = ((LEFT_BOX, NEARER), (RIGHT_BOX, FARTHER))


def test_two_boxes_are_two_objects(kernels):
    """Two boxes before a wall out of range come out as drawn: place and size to float32's rounding, boxes to
    the pixel, centroids in the middle to half a pixel, the larger first, nothing cut.
    """
    objects = segment(kernels, drawn(*TWO, wall=np.nan), NO_FLOOR, P)
    np.testing.assert_allclose(objects.boxes(NUMBERS), [LEFT_BOX, RIGHT_BOX], rtol=1e-12)
    np.testing.assert_allclose(objects.states, [metric(*each) for each in TWO], rtol=1e-6, atol=1e-6)
    assert objects.whole.all()
    np.testing.assert_allclose(objects.area, objects.states[:, 3] * objects.states[:, 4], rtol=1e-6)
    assert (np.abs(objects.centroid_offset) < 0.5 * objects.states[:, 2:3] / CAMERA.fx).all()


def test_a_wall_behind_changes_nothing(kernels):
    """With a wall behind them the boxes are the same, and the wall is one more object, cut by the image."""
    objects = segment(kernels, drawn(*TWO), NO_FLOOR, P)
    expected = [Box(0, 0, 176, 144), LEFT_BOX, RIGHT_BOX]
    np.testing.assert_allclose(objects.boxes(NUMBERS), expected, rtol=1e-12, atol=1e-10)
    assert objects.cut[0].all()
    assert objects.states[0, 2] == pytest.approx(WALL)


def test_distributions_are_shares(kernels):
    """Columns and rows sum to 1; of a full box they are even, but for whole pixels."""
    objects = segment(kernels, drawn(*TWO, wall=np.nan), NO_FLOOR, P)
    for each, sides in ((objects.columns, (36, 20)), (objects.rows, (100, 60))):
        assert each.shape == (2, DISTRIBUTION_BINS)
        np.testing.assert_allclose(each.sum(axis=1), 1, rtol=1e-6)
        for shares, side in zip(each, sides, strict=True):
            assert np.abs(shares - 1 / DISTRIBUTION_BINS).max() < 1 / side


def test_the_centroid_of_a_triangle(kernels):
    """A right triangle's centroid is a sixth of its sides off its box's center, within half a bin."""
    depth = np.full((144, 176), np.nan, np.float32)
    for row in range(96):
        depth[20 + row, 40 : 41 + row] = 3.0
    fg = Foreground(depth, NUMBERS, 1, (0, 0, 176, 144))
    objects = segment(kernels, fg, NO_FLOOR, P)
    expected = np.array([-1, 1]) * objects.states[0, 3:] / 6
    np.testing.assert_allclose(
        objects.centroid_offset[0], expected, atol=objects.states[0, 3:].max() / DISTRIBUTION_BINS / 2
    )


@pytest.mark.parametrize(
    ("box", "side"),
    [
        (Box(-10, 30, 40, 60), 0),
        (Box(150, 30, 40, 60), 1),
        (Box(60, -10, 40, 60), 2),
        (Box(60, 100, 40, 60), 3),
    ],
)
def test_the_border_cuts(box, side, kernels):
    """An object at the image's border may go on there, and only there."""
    objects = segment(kernels, drawn((box, NEARER), wall=np.nan), NO_FLOOR, P)
    assert objects.cut[0].tolist() == [i == side for i in range(4)]
    assert objects.whole[0].tolist() == [side >= 2, side < 2]


def test_what_is_in_front_cuts(kernels):
    """A farther box right beside a nearer one may go on behind it; the nearer one is whole."""
    front, behind = Box(40, 20, 40, 100), Box(80, 30, 40, 80)
    objects = segment(kernels, drawn((front, 2.0), (behind, 3.0), wall=np.nan), NO_FLOOR, P)
    nearer, farther = np.argsort(objects.states[:, 2])
    assert not objects.cut[nearer].any()
    assert objects.cut[farther].tolist() == [True, False, False, False]


def test_edges_separate_objects_that_touch(kernels):
    """Two boxes side by side, 0.15 m apart in depth, are two objects with edges, and one without."""
    boxes = ((Box(40, 30, 40, 80), 2.0), (Box(80, 30, 40, 80), 2.15))
    assert len(segment(kernels, drawn(*boxes, wall=np.nan), NO_FLOOR, P).states) == 2
    assert len(segment(kernels, drawn(*boxes, wall=np.nan), NO_FLOOR, Params(edges=False)).states) == 1


def test_a_few_pixels_are_no_object(kernels):
    """A few pixels are no object, whatever their depth."""
    objects = segment(kernels, drawn((Box(50, 50, 2, 3), NEARER), wall=np.nan), NO_FLOOR, P)
    assert len(objects.states) == 0


@pytest.mark.parametrize("far", [4.0, 8.0])
@pytest.mark.parametrize("z", [2.0, 3.9])
def test_an_object_has_an_area_at_the_far_end(far, z, kernels):
    """The least object is one of ``min_area`` m² at ``far``: where it is nearer it has as many pixels."""
    p = Params(min_area=0.03, far=far)
    least = int(p.min_area * CAMERA.fx * CAMERA.fy / far**2)  # pixels
    fewer = (least - 1) // 5
    for rows, is_one in ((fewer, False), (fewer + 1, True)):
        fg = drawn((Box(60, 30, 5, rows), z), wall=np.nan)
        assert len(segment(kernels, fg, NO_FLOOR, p).states) == is_one


@pytest.mark.parametrize(("columns", "is_one"), [(7, False), (9, True)])
def test_an_object_has_some_pixels(columns, is_one, kernels):
    """However small an object may be at ``far``, it has eight pixels."""
    fg = drawn((Box(60, 30, columns, 1), NEARER), wall=np.nan)
    assert len(segment(kernels, fg, NO_FLOOR, Params(min_area=1e-6)).states) == is_one


@pytest.mark.parametrize("wall", [np.nan, 0.1, 9.0])
def test_nothing_in_range_is_no_object(wall, kernels):
    """Without anything in range there are no objects, and each field has its shape."""
    objects = segment(kernels, drawn(wall=wall), NO_FLOOR, P)
    assert objects.states.shape == (0, 5)
    assert objects.cut.shape == (0, 4)
    assert objects.centroid_offset.shape == (0, 2)
    assert objects.columns.shape == objects.rows.shape == (0, DISTRIBUTION_BINS)
    assert objects.area.shape == (0,)
    assert objects.boxes(NUMBERS) == []


def test_objects_are_extended_down_to_the_floor(kernels):
    """An object that ends 0.2 m above the floor is extended down to it. Its foot stays in the column, its
    head where it is.
    """
    fg = drawn((LEFT_BOX, NEARER), wall=np.nan)
    bare = segment(kernels, fg, NO_FLOOR, P)
    foot = bare.states[0, 1] + bare.states[0, 4] / 2
    standing = segment(kernels, fg, np.array([0.0, -1.0, 0.0, foot + 0.2, 0.5, 0.0]), P)
    head = bare.states[0, 1] - bare.states[0, 4] / 2
    assert standing.states[0, 4] == pytest.approx(bare.states[0, 4] + 0.2)
    assert standing.states[0, 1] - standing.states[0, 4] / 2 == pytest.approx(head)
    (box,) = standing.boxes(NUMBERS)
    left, top, right, _ = LEFT_BOX.xyxy
    ((_, lowest),) = CAMERA.project(np.array([[0, foot + 0.2, NEARER]])) + 0.5
    np.testing.assert_allclose(box.xyxy, [left, top, right, lowest], rtol=1e-9)


@pytest.mark.parametrize("over", [-0.1, 0.5])
def test_objects_below_or_far_above_the_floor_are_not_extended(over, kernels):
    """An object below the floor, or far above it, stays as it is."""
    fg = drawn((LEFT_BOX, NEARER), wall=np.nan)
    bare = segment(kernels, fg, NO_FLOOR, P)
    foot = bare.states[0, 1] + bare.states[0, 4] / 2
    plane = np.array([0.0, -1.0, 0.0, foot + over, 0.5, 0.0])
    np.testing.assert_array_equal(segment(kernels, fg, plane, P).states, bare.states)


@pytest.mark.parametrize("resolution", [88, 59])
def test_boxes_of_thinned_images_are_where_their_states_are(resolution, kernels):
    """In a thinned image an object's box in pixels is its metric state as the camera sees it, and within
    a step of the box drawn.
    """
    p = Params(floor=False, resolution=resolution, gap_passes=0)
    depth = drawn((LEFT_BOX, NEARER), wall=np.nan).depth
    fg, plane = extract_foreground(kernels, depth, NUMBERS, NO_FLOOR, 0, p)
    objects = segment(kernels, fg, plane, p)
    (box,), ((x, y, z, w, h),) = objects.boxes(NUMBERS), objects.states
    assert np.abs(np.subtract(box, LEFT_BOX)).max() <= fg.step
    corners = np.array([[x - w / 2, y - h / 2, z], [x + w / 2, y + h / 2, z]])
    np.testing.assert_allclose(box.xyxy, (CAMERA.project(corners) + 0.5).ravel(), rtol=0, atol=1e-10)


def person(x: float = 0.0, z: float = 3.0, width: float = 0.5, height: float = 1.7) -> list[float]:
    """The state of a person."""
    return [x, 0.0, z, width, height]


@pytest.mark.parametrize(
    ("width", "height", "human"),
    [
        (0.5, 1.7, 1),
        (0.9, 1.0, 1),
        (0.5, 0.8, 0),
        (0.9, 2.3, 0),
        (1.8, 1.7, 0),
        (0.25, 1.7, 0),
        (0.45, 2.2, 1),
    ],
)
def test_people_have_a_size(width, height, human, objects_of):
    """A human candidate is 0.9 to 2.2 m tall, and one to six times as tall as wide."""
    assert len(find_people(objects_of([person(width=width, height=height)]), P)) == human


def test_furniture_fills_its_box(objects_of):
    """What fills its box is no human candidate; where it is cut it may be one, but comes after all others."""
    objects = objects_of(3 * [person()], [[0, 0, 0, 0], [0, 0, 0, 1], [0, 0, 0, 0]])
    objects.area[:] = objects.states[:, 3] * objects.states[:, 4] * [0.9, 0.9, 0.5]
    assert find_people(objects, P).tolist() == [2, 1]


def test_people_are_listed_largest_first(objects_of):
    """Candidates keep the objects' order, which is by size, without those that are none."""
    objects = objects_of([person(width=0.9), person(height=0.3), person(width=0.6), person(width=0.5)])
    assert find_people(objects, P).tolist() == [0, 2, 3]


def test_a_person_cut_by_the_border_may_be_narrow(objects_of):
    """Somebody whose width the border cuts may be too narrow, but not too wide."""
    cut = [[1, 0, 0, 0]]
    assert len(find_people(objects_of([person(width=0.2)], cut), P)) == 1
    assert len(find_people(objects_of([person(width=1.9)], cut), P)) == 0


def test_as_printed_who_is_cut_is_as_wide_as_is_seen(objects_of):
    """Section IV.A knows no cuts: whatever the border cuts is no human candidate where it is too narrow."""
    narrow, paper = objects_of([person(width=0.2)], [[1, 0, 0, 0]]), Params.paper()
    assert len(find_people(narrow, paper)) == 0
    assert len(find_people(objects_of([person(width=0.4)], [[1, 0, 0, 0]]), paper)) == 1


def test_nobody_is_an_error_that_asks_for_a_box(objects_of):
    """Without a candidate the error names the box, and, where there is nothing else either, the range."""
    with pytest.raises(TargetNotFoundError, match=r"^box: expected .*nobody was found in this frame$"):
        initialize_on_person(objects_of([person(height=0.3)]), P)
    with pytest.raises(TargetNotFoundError, match=r"nobody was found.*, nor anything else .*0\.3 and 8 m$"):
        initialize_on_person(objects_of([]), P)


def test_a_box_starts_at_the_depth_of_its_object(kernels):
    """A box drawn loosely around an object is that object; one drawn badly has its depth."""
    fg = drawn(*TWO)
    objects = segment(kernels, fg, NO_FLOOR, P)
    loose = Box(LEFT_BOX.x - 4, LEFT_BOX.y - 6, LEFT_BOX.width + 9, LEFT_BOX.height + 8)
    found = initialize_in_box(loose, objects, fg, P)
    np.testing.assert_allclose(found.state, metric(LEFT_BOX, NEARER), rtol=1e-6)
    assert found.whole.all()
    upper = Box(LEFT_BOX.x, LEFT_BOX.y, LEFT_BOX.width, 0.4 * LEFT_BOX.height)
    np.testing.assert_allclose(
        initialize_in_box(upper, objects, fg, P).state, metric(upper, NEARER), rtol=1e-6
    )


@pytest.mark.parametrize("side", range(4), ids=["left", "top", "right", "bottom"])
def test_of_an_object_that_goes_on_around_the_box_the_side_is_the_boxes(side, kernels):
    """A box on the end of a table is that end: three sides are the object's, the fourth is the box's own."""
    end, table = [60, 40, 110, 100], [60, 40, 110, 100]
    table[side] += -30 if side < 2 else 30
    fg = drawn((Box.from_xyxy(*table), NEARER), wall=np.nan)
    loose = [each + by for each, by in zip(end, (-2, -3, 2, 3), strict=True)]
    loose[side] = end[side]
    box = Box.from_xyxy(*loose)
    objects = segment(kernels, fg, NO_FLOOR, P, region=region_in(box, fg))
    found = project_box(initialize_in_box(box, objects, fg, P).state, NUMBERS)
    np.testing.assert_allclose(found.xyxy, end, atol=1e-6)


@pytest.mark.parametrize("resolution", [176, 88, 59])
def test_a_box_in_a_thinned_image_is_where_it_was_given(resolution, kernels):
    """The start is the box in the frame's pixels, and whole, however the image is thinned; so it is on a
    surface without an object of its own.
    """
    p = Params(floor=False, resolution=resolution, gap_passes=0)
    box = Box(100, 80, 60, 50)
    for depth in (drawn((box, NEARER), wall=np.nan).depth, np.full((144, 176), 3.0, np.float32)):
        fg, plane = extract_foreground(kernels, depth, NUMBERS, NO_FLOOR, 0, p)
        start = initialize_in_box(box, segment(kernels, fg, plane, p), fg, p)
        assert start.whole.all()
        assert np.abs(np.subtract(project_box(start.state, NUMBERS), box)).max() < fg.step


def test_of_an_object_that_is_cut_no_size_is_known(kernels):
    """A head at the lower border has a width, but shoulders below it are wider; so with a loose box."""
    head = Box(60, 120, 24, 24)
    fg = drawn((head, NEARER), wall=np.nan)
    inside = Box(60, 118, 24, 20)
    for box in (head, inside):
        assert not initialize_in_box(box, segment(kernels, fg, NO_FLOOR, P), fg, P).whole.any()


@pytest.mark.parametrize("inside", [2, 1])
@pytest.mark.parametrize("side", range(4), ids=["left", "top", "right", "bottom"])
def test_of_a_box_at_the_border_the_size_is_not_known(side, inside, kernels):
    """A box on no object is whole where it is two pixels inside the image, and cut where it is nearer."""
    sides = [60, 60, 80, 90]
    sides[side] = [inside, inside, 176 - inside, 144 - inside][side]
    fg = drawn(wall=3.0)
    nothing = segment(kernels, drawn(wall=np.nan), NO_FLOOR, P)
    whole = initialize_in_box(Box.from_xyxy(*sides), nothing, fg, P).whole
    assert whole.tolist() == [inside == 2 or side % 2 == 1, inside == 2 or side % 2 == 0]


def test_the_edge_of_what_was_measured_cuts(kernels):
    """A registered image has margins without depth: what ends at a margin may go on there. What is alone
    in an image isn't cut by its own outline.
    """
    fg = drawn((Box(6, 30, 40, 60), NEARER))
    depth = fg.depth.copy()
    depth[:, :6] = np.nan
    margin, _ = extract_foreground(kernels, depth, NUMBERS, NO_FLOOR, 0, Params(floor=False, gap_passes=0))
    assert margin.measured == (6, 0, 176, 144)
    objects = segment(kernels, margin, NO_FLOOR, P)
    nearest = int(np.argmin(objects.states[:, 2]))
    assert objects.cut[nearest].tolist() == [True, False, False, False]
    assert not segment(kernels, drawn((Box(60, 30, 40, 60), NEARER), wall=np.nan), NO_FLOOR, P).cut.any()


def test_only_searched_pixels_make_objects(kernels):
    """Where no object is looked for there is none, and what is there still cuts those beside it."""
    fg = drawn((Box(40, 20, 40, 100), 2.0), (Box(80, 30, 40, 80), 3.0), wall=np.nan)
    height, width = fg.depth.shape
    objects = segment(kernels, fg, NO_FLOOR, P, region=(80, 0, width, height))
    both = segment(kernels, fg, NO_FLOOR, P)
    farther = int(np.argmax(both.states[:, 2]))
    np.testing.assert_array_equal(objects.states, both.states[[farther]])
    assert objects.cut.tolist() == [[True, False, False, False]]


@pytest.mark.parametrize("pitch", [0, 15, 30])
def test_who_stands_before_a_tilted_camera_has_one_distance(pitch, kernels):
    """An upright panel has the same distance along the ground in each of its pixels, however the camera is
    tilted, to float32's rounding; its depths differ. It is one object.
    """
    angle, distance = math.radians(pitch), 3.0
    plane = np.array([0.0, -math.cos(angle), -math.sin(angle), 2.0, 0.5, 0.0])
    v, u = np.indices((144, 176))
    rays = np.stack([(u - CAMERA.cx) / CAMERA.fx, (v - CAMERA.cy) / CAMERA.fy, np.ones(u.shape)], axis=-1)
    depth = distance / (rays @ [0.0, -math.sin(angle), math.cos(angle)])
    panel = np.zeros(depth.shape, np.bool_)
    panel[20:130, 70:100] = True
    fg = Foreground(np.where(panel, depth, np.nan).astype(np.float32), NUMBERS, 1, (0, 0, 176, 144))
    found = kernels.ground_distance(fg.depth, fg.camera, plane[:3], P.near, P.far)
    np.testing.assert_allclose(found[panel], distance, rtol=1e-6)
    assert np.isnan(found[~panel]).all()
    assert (np.ptp(depth[panel]) > 0.2) == (pitch > 0)
    assert len(segment(kernels, fg, plane, P).states) == 1


def test_a_box_on_no_object_has_the_depth_of_its_middle(kernels):
    """A box on a part of something has the median depth of its middle."""
    fg = drawn((LEFT_BOX, NEARER))
    objects = segment(kernels, fg, NO_FLOOR, P)
    part = Box(LEFT_BOX.x + 10, LEFT_BOX.y + 10, 12, 12)
    np.testing.assert_allclose(initialize_in_box(part, objects, fg, P).state, metric(part, NEARER), rtol=1e-6)


@pytest.mark.parametrize("resolution", [176, 88])
@pytest.mark.parametrize("box", [Box(60, 20, 12, 80), Box(20, 60, 80, 12)], ids=["tall", "wide"])
def test_the_middle_of_a_box_is_half_of_it_along_either_side(box, resolution, kernels):
    """A box on no object has the depth of the middle half of its columns and rows."""
    x, y, width, height = box
    middle = Box(x + width / 4, y + height / 4, width / 2, height / 2)
    p = Params(floor=False, resolution=resolution, gap_passes=0)
    depth = drawn((box, 3.0), (middle, 2.0)).depth
    fg, _ = extract_foreground(kernels, depth, NUMBERS, NO_FLOOR, 0, p)
    objects = segment(kernels, drawn(wall=np.nan), NO_FLOOR, P)
    assert initialize_in_box(box, objects, fg, P).state[2] == 2.0


@pytest.mark.parametrize(
    "box", [Box(170, 60, 40, 40), Box(-34, 60, 40, 40), Box(60, 138, 40, 40), Box(60, -34, 40, 40)]
)
def test_a_box_mostly_outside_has_the_depth_of_the_nearest_pixels(box, kernels):
    """Of a box whose middle is outside the image the pixels at that border give the depth."""
    fg = drawn((box, 2.0), wall=3.0)
    objects = segment(kernels, drawn(wall=np.nan), NO_FLOOR, P)
    assert initialize_in_box(box, objects, fg, P).state[2] == 2.0


@pytest.mark.parametrize(
    ("wall", "by", "is_object"), [(3.0, 0.15, True), (3.0, 0.04, False), (7.0, 0.15, False)]
)
def test_what_stands_off_a_known_wall_is_an_object(wall, by, is_object, kernels):
    """Somebody 15 cm in front of a wall that was seen before is an object; 4 cm, and far away, where sensors
    are as noisy as that, 15 cm, are not enough.
    """
    others = np.full((144, 176), wall, np.float32)
    fg = drawn((LEFT_BOX, wall - by), wall=wall)
    assert len(segment(kernels, fg, NO_FLOOR, P, others=others).states) == is_object


@pytest.mark.parametrize("size", [2, 3, 5])
@pytest.mark.parametrize("corner", range(60, 66))
def test_a_small_box_in_a_thinned_image_has_a_depth(size, corner, kernels):
    """Wherever a small box lies on a measured surface, a thinned image has a depth for it."""
    p = Params(floor=False, resolution=44)
    fg, plane = extract_foreground(kernels, np.full((144, 176), 3.0, np.float32), NUMBERS, NO_FLOOR, 0, p)
    found = initialize_in_box(Box(corner, corner, size, size), segment(kernels, fg, plane, p), fg, p)
    assert found.state[2] == pytest.approx(3.0)


def test_a_box_on_nothing_is_named(kernels):
    """A box without a measurement in its middle is an error that names it."""
    with pytest.raises(ValueError, match=r"^box: expected a target with measured depth"):
        initialize_in_box(
            Box(10, 10, 20, 20), segment(kernels, drawn(wall=np.nan), NO_FLOOR, P), drawn(wall=np.nan), P
        )
