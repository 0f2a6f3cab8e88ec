# SPDX-License-Identifier: MIT
import math

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Frame, Status, Track
from tricue.draw.canvas import STATUS_COLORS
from tricue.draw.depth_pictures import depth_picture, depth_range
from tricue.draw.overlays import depth_overlay, overlay
from tricue.draw.targets import targets_overlay

BLACK = np.zeros((480, 640, 3), np.uint8)


BOX = Box(200, 300, 60, 80)


def track(box: Box = BOX, status: Status = Status.TRACKED) -> Track:
    """A track to draw."""
    return Track(box, 0.5, status)


@pytest.mark.parametrize("status", list(Status))
def test_the_box_is_where_it_should_be(status: Status) -> None:
    """It proves that all four edges of the box are drawn at its pixels in the color of the status."""
    picture = overlay(BLACK, track(status=status))
    for row, column in [(300, 230), (379, 230), (340, 200), (340, 259)]:
        assert tuple(picture[row, column]) == STATUS_COLORS[status]


def test_a_frame_is_drawn_as_its_images_are() -> None:
    """It proves that what a tracker takes can be drawn: a frame's color, or its depth if it has no color."""
    depth = np.full((48, 64), 2.0, np.float32)
    for frame in (Frame(BLACK), Frame(BLACK, depth=depth)):
        assert np.array_equal(overlay(frame, track(), note="a"), overlay(BLACK, track(), note="a"))
    drawn = overlay(Frame(depth=depth), track(), truth=BOX)
    assert np.array_equal(drawn, depth_overlay(depth, track(), truth=np.array(BOX)))
    assert np.array_equal(overlay(BLACK, track(), truth=BOX), overlay(BLACK, track(), truth=tuple(BOX)))


def test_the_image_is_left_alone() -> None:
    """It proves that drawing works on a copy."""
    image = BLACK.copy()
    picture = overlay(image, track(), particles=[[230, 340]], truth=Box(190, 290, 60, 80), note="frame 1")
    assert np.array_equal(image, BLACK)
    assert picture.any()


def test_small_images_are_enlarged() -> None:
    """It proves that a small picture, gray or color, becomes a BGR one of readable size, box and all."""
    for image in (BLACK[:120, :160], BLACK[:120, :160, 0]):
        picture = overlay(image, track(Box(50, 75, 15, 20)))
        assert picture.shape == (480, 640, 3)
        assert tuple(picture[300, 230]) == STATUS_COLORS[Status.TRACKED]


def test_lines_are_seen_in_a_large_image_shown_smaller() -> None:
    """It proves that the box keeps its color where a 4K picture is shown with a third of its size."""
    box = Box(600, 900, 600, 900)
    large = np.zeros((2160, 3840, 3), np.uint8)
    for picture in (overlay(large, track(box)), targets_overlay(large, {1: track(box)})):
        small = cv2.resize(picture, None, fx=1 / 3, fy=1 / 3, interpolation=cv2.INTER_AREA).astype(int)
        assert small[400:450, 198:203].sum(2).max(1).min() > 300


def test_a_tiny_target_stays_visible() -> None:
    """It proves that nothing is drawn within a tiny box, as there is an ellipse within others."""
    for side, drawn in ((14, False), (40, True)):
        picture = overlay(BLACK, track(Box(200, 300, side, side)))
        assert picture[303 : 297 + side, 203 : 197 + side].any() == drawn


def test_text_fits_an_upright_image() -> None:
    """It proves that the longest line, the position, is as long in an upright image as in a wide one."""
    whole = Track(BOX, 0.5, Status.TRACKED, position=np.array([-1.23, 0.45, 12.3]), covariance=np.eye(3))
    pictures = [overlay(np.zeros(shape, np.uint8), whole) for shape in ((1920, 1080, 3), (1080, 1920, 3))]
    columns = [np.flatnonzero(picture[:250].any((0, 2))).max() for picture in pictures]
    assert columns[0] == columns[1] < 1000


@pytest.mark.parametrize(("shape", "scale"), [((20, 2000), 2), ((20, 5000), 1), ((20, 100), 24)])
def test_wide_images_stay_narrow_enough_for_a_video(shape: tuple[int, int], scale: int) -> None:
    """It proves that an image of few rows isn't enlarged beyond the columns that encoders take."""
    image, box = np.zeros((*shape, 3), np.uint8), Box(20, 2, 16, 16)
    large = scale * shape[0], scale * shape[1], 3
    assert overlay(image, track(box)).shape == large
    assert depth_overlay(np.ones(shape, np.float32), track(box)).shape == large
    assert targets_overlay(image, {1: track(box)}).shape == large


def test_particles_are_dots() -> None:
    """It proves that each particle changes the pixels at its center."""
    particles = np.array([[500.0, 100.0, 9, 9], [550.0, 120.0, 9, 9]])
    picture = overlay(BLACK, track(), particles=particles)
    for x, y, *_ in particles.astype(int):
        assert picture[y, x].any()


@pytest.mark.parametrize(
    "box", [Box(-50, -50, 20, 20), Box(600, 440, 900, 900), Box(1e6, -1e6, 1e6, 1e6), Box(3, 3, 0.01, 0.01)]
)
def test_boxes_anywhere_are_drawn(box: Box) -> None:
    """It proves that boxes outside, across the edge, huge or tiny don't disturb the drawing."""
    assert overlay(BLACK, track(box), particles=[[math.inf, 0], [-1e9, 1e9]]).shape == BLACK.shape


def ramp() -> NDArray[np.float32]:
    """Depth from 1 m at the left to 5 m at the right, 480x640, and a corner without measurement."""
    depth = np.tile(np.linspace(1, 5, 640, dtype=np.float32), (480, 1))
    depth[:20, :20] = np.nan
    return depth


def lightness(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """L of CIE Lab."""
    return cv2.cvtColor(picture, cv2.COLOR_BGR2LAB)[..., 0]


def test_near_is_bright_and_missing_is_black() -> None:
    """It proves that the lightness falls with the depth all the way, and only what is missing is black."""
    picture = depth_picture(ramp(), 1.0, 5.0)
    assert (picture.shape, picture.dtype) == ((480, 640, 3), np.uint8)
    row = lightness(picture)[100].astype(int)
    assert row[0] > 200
    assert row[-1] < 50
    assert np.diff(row[::8]).max() <= 0
    assert (picture.max(axis=2) == 0).sum() == 400
    assert not picture[:20, :20].any()


def test_the_range_of_shades() -> None:
    """It proves that depths beyond near and far have their shades, and without them a few far pixels don't
    darken the rest: the 2nd and the 98th percentile are taken.
    """
    picture = depth_picture(ramp(), 2.0, 3.0)
    assert (picture[100, :150] == picture[100, 0]).all()
    assert (picture[100, 330:] == picture[100, -1]).all()
    assert depth_range(ramp()) == pytest.approx((1.08, 4.92), abs=0.03)
    outlier = ramp()
    outlier[400:404] = 4000.0
    apart = np.abs(depth_picture(outlier).astype(int) - depth_picture(ramp()))[100]
    assert apart.max() < 12


@pytest.mark.parametrize("value", [np.nan, 2.0])
def test_flat_depth_is_drawn(value: float) -> None:
    """It proves that a wall, and an image without any measurement, don't disturb the drawing."""
    flat = np.full((48, 64), value, np.float32)
    assert depth_picture(flat).any() == np.isfinite(value)
    assert (depth_range(flat) is None) == np.isnan(value)
    assert depth_overlay(flat, track()).shape == (480, 640, 3)


def test_the_range_of_a_wall_can_be_drawn() -> None:
    """It proves that other frames can be drawn in its range, as a report's are."""
    wall = np.full((48, 64), 2.0, np.float32)
    near, far = depth_range(wall) or (0.0, 0.0)
    assert depth_picture(wall + 1, near, far).shape == (48, 64, 3)


def test_scattered_depth_has_a_range() -> None:
    """It proves that depth measured in a few pixels only still has its own range."""
    depth = np.full((480, 640), np.nan, np.float32)
    depth[[1, 3], [1, 3]] = 2.0, 4.0
    assert depth_range(depth) == pytest.approx((2.04, 3.96))


@pytest.mark.parametrize(("near", "far"), [(2.0, 2.0), (3.0, 1.0), (math.nan, 1.0)])
def test_a_bad_range_is_refused(near: float, far: float) -> None:
    """It proves that a near that isn't below far is an error that names both."""
    with pytest.raises(ValueError, match="near, far: expected near below far, meters, got"):
        depth_picture(ramp(), near, far)


def test_what_a_depth_overlay_shows() -> None:
    """It proves that box, particles, objects, truth and position are each drawn where they belong."""
    plain = depth_picture(ramp())
    where = {
        "particles": ({"particles": [[500, 200, 20, 40, 2.0]]}, (200, 500)),
        "objects": ({"objects": [Box(400, 100, 50, 60)]}, (130, 400)),
        "truth": ({"truth": Box(450, 300, 50, 60)}, (330, 450)),
    }
    bare = depth_overlay(ramp(), track())
    for row, column in [(300, 230), (379, 230), (340, 200), (340, 259)]:
        assert tuple(bare[row, column]) == STATUS_COLORS[Status.TRACKED]
    for options, place in where.values():
        assert tuple(bare[place]) == tuple(plain[place])
        assert tuple(depth_overlay(ramp(), track(), **options)[place]) != tuple(plain[place])  # type: ignore[arg-type]


def test_the_position_is_written() -> None:
    """It proves that a position adds a line of text, to color and to depth, and its numbers change it."""
    texts = []
    for z in (2.84, 3.84):
        solid = Track(BOX, 0.5, Status.TRACKED, np.array([0.31, -0.1, z]))
        for flat, drawn in (
            (overlay(BLACK, track()), overlay(BLACK, solid)),
            (depth_overlay(ramp(), track()), depth_overlay(ramp(), solid)),
        ):
            changed = np.argwhere((flat != drawn).any(axis=2))
            assert changed[:, 0].min() > 40  # under the two other lines
            assert changed[:, 0].max() < 80
        texts.append(drawn)
    assert not np.array_equal(*texts)


def test_no_note_leaves_the_picture_as_it_is():
    """Nothing is darkened where a second line of text would be."""
    bright = np.full((480, 640, 3), 200, np.uint8)
    without, status_rows = overlay(bright, track(), note=""), slice(0, 100)
    noted = overlay(bright, track(), note="a note")
    darkened = [(picture[status_rows] < 100).any(axis=(1, 2)).sum() for picture in (without, noted)]
    assert darkened[0] < darkened[1]
    assert (without[30:100] == 200).all()
