# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Status, Track
from tricue.draw.masks import block_picture, flow_depth_overlay
from tricue.draw.overlays import overlay

BOX = Box(200, 200, 60, 80)
TRACK = Track(BOX, 0.5, Status.TRACKED, np.array([0.0, 0.0, 2.0]))
GRAY = np.full((480, 640, 3), 100, np.uint8)


def mask_of(box: Box) -> NDArray[np.uint8]:
    """(480, 640) 255 in a box."""
    mask = np.zeros((480, 640), np.uint8)
    left, top, right, bottom = map(int, box.xyxy)
    mask[top:bottom, left:right] = 255
    return mask


def test_target_pixels_are_tinted() -> None:
    """It proves that without blocks the pixels of the mask are changed, and no others."""
    inside = Box(210, 210, 30, 40)
    changed = flow_depth_overlay(GRAY, TRACK, mask_of(inside)) != overlay(GRAY, TRACK, ellipse=False)
    np.testing.assert_array_equal(changed.any(axis=2), mask_of(inside) > 0)


def test_blocks_are_outlined_and_the_occluded_crossed() -> None:
    """It proves that a target block is drawn along its edge, an occluded one through its middle, too."""
    none = np.zeros((480, 640), np.uint8)
    plain = flow_depth_overlay(GRAY, TRACK, none)
    targets, occluded = (Box(300, 300, 41, 41),), (Box(400, 300, 41, 41),)
    changed = (flow_depth_overlay(GRAY, TRACK, none, (targets, occluded)) != plain).any(axis=2)
    assert not changed[320, 320]
    assert changed[320, 420]
    assert changed[300, 320]
    rows, columns = np.nonzero(changed)
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (300, 340, 300, 440)


def test_paper_picture_is_white_and_black() -> None:
    """It proves that it is enlarged, target pixels are white, block edges black, the window white."""
    small = np.full((120, 160), 100, np.uint8)
    mask = np.zeros((120, 160), np.uint8)
    mask[50, 60] = 255
    picture = block_picture(small, mask, (Box(40, 40, 10, 10), Box(50, 40, 10, 10)))
    assert picture.shape == (480, 640, 3)
    assert (picture[200:204, 240:244] == 255).all()
    assert (picture[165:195, 199] == 0).all()
    assert (picture[160, 160:240] == 255).all()
    without = block_picture(small, mask, (Box(40, 40, 10, 10), Box(50, 40, 10, 10)), window=False)
    assert (without[160, 160:240] == 0).all()
    np.testing.assert_array_equal(block_picture(small, None), np.full((480, 640, 3), 100))


@pytest.mark.parametrize("box", [Box(-1e6, -1e6, 2e6, 2e6), Box(639, 479, 60, 80), Box(300, 200, 0.01, 0.01)])
def test_tracks_anywhere_are_drawn(box: Box) -> None:
    """It proves that boxes and blocks across the edge, huge or tiny, don't disturb the drawing."""
    track = Track(box, 0.5, Status.OCCLUDED)
    gray = np.full((120, 160), 100, np.uint8)
    picture = flow_depth_overlay(gray, track, gray, ((box,), (box,)), truth=BOX, note="frame 1")
    assert picture.shape == (480, 640, 3)


def test_mask_has_the_images_size() -> None:
    """It proves that a mask of another size is an error that says so."""
    with pytest.raises(ValueError, match=r"mask: expected the image's shape \(480, 640\), got \(120, 160\)"):
        flow_depth_overlay(GRAY, TRACK, np.zeros((120, 160), np.uint8))
