# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Frame, Intrinsics, Status, StereoRig, Track
from tricue.draw.overlays import overlay
from tricue.draw.stereo import measure_disparity, stereo_overlay

RIG = StereoRig(Intrinsics(400.0, 400.0, 319.5, 239.5, 640, 480), 0.1)
DISPARITY = 20  # pixels, of everything; at 400 * 0.1 / 20 = 2 m
BOX = Box(200, 200, 60, 80)
PLACE = np.array([0.0, 0.0, 2.0])


@pytest.fixture(scope="module")
def frame() -> Frame:
    """A wall with a pattern, at DISPARITY."""
    wall = np.random.default_rng(0).integers(0, 256, (480, 640 + DISPARITY, 3), np.uint8)
    return Frame(wall[:, :640], right=wall[:, DISPARITY:])


def track(box: Box = BOX, place: NDArray[np.float64] | None = PLACE) -> Track:
    """A track to draw."""
    return Track(box, 0.5, Status.TRACKED, place)


def test_the_disparity_is_that_of_the_pair(frame: Frame) -> None:
    """It proves that the disparity of the target and its surround is measured, as its distance expects it."""
    patch = measure_disparity(frame, track(), RIG)
    assert patch is not None
    assert patch.expected == pytest.approx(DISPARITY)
    assert (patch.left, patch.top) == (182, 176)
    assert patch.disparity.shape == (128, 96)
    np.testing.assert_allclose(patch.disparity, DISPARITY, atol=0.3)


@pytest.mark.parametrize(
    ("box", "rows", "columns"),
    [
        (BOX, (240, 480), (320, 640)),
        (Box(520, 390, 60, 80), (240, 480), (0, 320)),
        (Box(10, 390, 600, 80), (0, 240), (320, 640)),
    ],
)
def test_the_inset_stands_apart(
    frame: Frame, box: Box, rows: tuple[int, int], columns: tuple[int, int]
) -> None:
    """It proves that the inset alone is added to the overlay, in a corner in which the target isn't."""
    assert frame.color is not None
    added = overlay(frame.color, track(box)) != stereo_overlay(frame, track(box), RIG)
    where = np.nonzero(added.any(axis=2))
    assert len(where[0]) > 3000
    for (start, stop), found in zip((rows, columns), where, strict=True):
        assert start <= found.min() <= found.max() < stop


def test_a_low_picture_has_room_for_a_small_inset() -> None:
    """It proves that an inset stays inside a picture that is lower than the inset's caption."""
    wall = np.random.default_rng(0).integers(0, 256, (10, 5000 + DISPARITY, 3), np.uint8)
    low = Frame(wall[:, :-DISPARITY], right=wall[:, DISPARITY:])
    assert stereo_overlay(low, track(Box(200, 1, 8, 8)), RIG).shape == (10, 5000, 3)


@pytest.mark.parametrize(
    ("box", "place"),
    [
        (BOX, None),
        (BOX, np.array([0.0, 0.0, -1.0])),
        (BOX, np.full(3, np.nan)),
        (Box(-500, 200, 60, 80), PLACE),
        (Box(670, 200, 60, 80), PLACE),
    ],
)
def test_there_is_not_always_an_inset(frame: Frame, box: Box, place: NDArray[np.float64] | None) -> None:
    """It proves that without a position in front, or beside the image, the plain overlay remains."""
    assert frame.color is not None
    assert measure_disparity(frame, track(box, place), RIG) is None
    drawn = stereo_overlay(frame, track(box, place), RIG)
    assert np.array_equal(drawn, overlay(frame.color, track(box, place)))


@pytest.mark.parametrize(
    ("box", "z"),
    [
        (Box(-900, -900, 3000, 3000), 0.001),  # nearer than any camera sees: disparities beyond the image
        (Box(639, 479, 60, 80), 2.0),
        (Box(-59, -79, 60, 80), 2.0),
        (Box(300, 200, 0.01, 0.01), 1e6),
        (Box(1e6 - 1, 0, 1e6, 1e6), 2.0),
        (Box(-1e6, -1e6, 2e6, 2e6), 2.0),
    ],
)
def test_tracks_anywhere_are_drawn(frame: Frame, box: Box, z: float) -> None:
    """It proves that boxes across the edge, huge or tiny, near or far, don't disturb the drawing."""
    solid = track(box, np.array([0.0, 0.0, z]))
    assert stereo_overlay(frame, solid, RIG, truth=BOX, note="frame 1").shape == (480, 640, 3)


def test_gray_pairs_are_drawn(frame: Frame) -> None:
    """It proves that a pair of gray images has its inset too, and small ones are enlarged with it."""
    assert frame.color is not None
    assert frame.right is not None
    gray = Frame(frame.color[:120, :160, 0], right=frame.right[:120, :160, 0])
    picture = stereo_overlay(gray, track(Box(60, 60, 20, 20)), RIG)
    assert picture.shape == (480, 640, 3)
    assert (picture[300:420, 480:630].std(axis=2) > 0).any()  # shades of disparity aren't gray


def test_a_pair_is_needed(frame: Frame) -> None:
    """It proves that a frame without a right image is an error that says so."""
    with pytest.raises(ValueError, match="frame: expected the channel right"):
        stereo_overlay(Frame(frame.color), track(), RIG)
