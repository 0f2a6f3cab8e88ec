# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue import Box, Frame, Status, Track
from tricue.draw.depth_pictures import depth_picture
from tricue.draw.targets import TARGET_COLORS, target_color, targets_overlay

BLACK = np.zeros((480, 640, 3), np.uint8)
BOXES = Box(100, 200, 60, 80), Box(400, 100, 50, 90)


def tracks(status: Status = Status.TRACKED) -> dict[int, Track]:
    """Two targets."""
    return {number: Track(box, 0.5, status) for number, box in zip((1, 2), BOXES, strict=True)}


def test_each_box_has_its_color():
    """All edges of a box are drawn at its pixels in the color of its target's id."""
    picture = targets_overlay(BLACK, tracks())
    for target, box in zip((1, 2), BOXES, strict=True):
        left, top, right, bottom = map(int, box.xyxy)
        middle = (left + right) // 2, (top + bottom) // 2
        for x, y in ((left, middle[1]), (right - 1, middle[1]), (middle[0], top), (middle[0], bottom - 1)):
            assert tuple(picture[y, x]) == target_color(target)
    assert not BLACK.any()


def test_a_frame_is_drawn_as_its_images_are():
    """What MultiTracker.update takes can be drawn: a frame's color, or its depth if it has no color."""
    depth = np.linspace(1, 3, 480 * 640).reshape(480, 640).astype(np.float32)
    drawn = targets_overlay(Frame(BLACK, depth=depth), tracks())
    np.testing.assert_array_equal(drawn, targets_overlay(BLACK, tracks()))
    drawn = targets_overlay(Frame(depth=depth), tracks())
    np.testing.assert_array_equal(drawn, targets_overlay(depth_picture(depth), tracks()))


def test_colors_differ():
    """Those of targets that follow one another; after the last they begin again."""
    colors = [target_color(target) for target in range(1, len(TARGET_COLORS) + 2)]
    assert len(set(colors[:-1])) == len(TARGET_COLORS)
    assert colors[-1] == colors[0]
    differences = np.abs(np.array(colors[:-1])[:, None] - np.array(colors[:-1])).sum(2)
    assert differences[~np.eye(len(TARGET_COLORS), dtype=bool)].min() > 60


def test_ids_and_status_are_written():
    """The id is above the box, with the status where it isn't tracked; another id looks otherwise."""
    above = np.s_[160:198, 100:200]
    one = targets_overlay(BLACK, {1: tracks()[1]})[above]
    other = targets_overlay(BLACK, {8: tracks()[1]})[above]  # of the same color
    lost = targets_overlay(BLACK, {1: tracks(Status.LOST)[1]})[above]
    assert one.any()
    assert not np.array_equal(one, other)
    assert np.count_nonzero(lost) > 2 * np.count_nonzero(one)


@pytest.mark.parametrize("box", [Box(-50, -50, 20, 20), Box(0, 0, 640, 480), Box(1e6, -1e6, 1e6, 1e6)])
def test_boxes_anywhere_are_drawn(box):
    """The id is in the picture also where the box isn't."""
    picture = targets_overlay(BLACK, {1: Track(box, 0.5, Status.OCCLUDED)}, note="frame 3")
    assert picture.shape == BLACK.shape
    assert (picture[:, 300:] if box.x > 0 else picture).any()


def test_small_and_gray_images_are_enlarged():
    """A small gray picture becomes a BGR one of readable size."""
    picture = targets_overlay(BLACK[:120, :160, 0], {3: Track(Box(50, 75, 15, 20), 0.5, Status.TRACKED)})
    assert picture.shape == (480, 640, 3)
    assert tuple(picture[300, 230]) == target_color(3)
