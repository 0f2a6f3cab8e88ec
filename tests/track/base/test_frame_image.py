# SPDX-License-Identifier: MIT
"""Images that are frames, and the adapter's ways to give and take them."""

import copy

import cv2
import numpy as np
import pytest
from tricue import Box, Frame, Status, Track, create
from tricue.errors import MissingChannelError
from tricue.track.base.adapter import adapt_class, with_known_numbers
from tricue.track.base.frame_image import FrameImage

PIXELS = np.arange(40 * 60 * 3, dtype=np.uint8).reshape(40, 60, 3)


def test_it_is_the_image_and_has_the_frame() -> None:
    """It proves that cv2 and NumPy see the pixels, without a copy, and that the frame's parts are there."""
    frame = Frame(PIXELS, np.ones((40, 60)), timestamp=2.5, pose=np.eye(4))
    image = FrameImage.of(frame)
    assert image.base is not None
    assert np.shares_memory(image, frame.color)
    assert type(image.color) is np.ndarray
    np.testing.assert_array_equal(
        cv2.cvtColor(image, cv2.COLOR_BGR2GRAY), cv2.cvtColor(PIXELS, cv2.COLOR_BGR2GRAY)
    )
    assert image.depth is frame.depth
    assert (image.timestamp, image.right) == (2.5, None)
    assert image.pose == frame.pose


def test_what_is_made_of_it_has_no_frame() -> None:
    """It proves that a crop, which has other pixels, doesn't have the whole frame's depth."""
    image = FrameImage.of(Frame(PIXELS, np.ones((40, 60)), timestamp=2.5))
    crop = image[5:9, 3:8]
    assert (crop.shape, crop.depth, crop.timestamp) == ((4, 5, 3), None, None)
    assert float((image + 1).mean()) == pytest.approx(float((PIXELS + 1).mean()))


def test_a_frame_without_color_has_no_image() -> None:
    """It proves that the missing channel is named."""
    with pytest.raises(MissingChannelError, match="channel color"):
        FrameImage.of(Frame(depth=np.ones((4, 5))))


class Says:
    """Returns what it is told to."""

    def __init__(self, answer=None, seed=None):
        self.answer, self.seed = answer, seed

    def init(self, image, box):
        assert isinstance(image, FrameImage)
        return True

    def update(self, image):
        return self.answer


class Plain(Says):
    def __init__(self):
        super().__init__()


FIRST, OTHER = Box(1.0, 2.0, 10.0, 12.0), (3, 4, 5, 6)


@pytest.mark.parametrize(
    ("answer", "track"),
    [
        (OTHER, Track(Box(*OTHER), 1.0, Status.TRACKED)),
        (np.array(OTHER), Track(Box(*OTHER), 1.0, Status.TRACKED)),
        ((True, OTHER), Track(Box(*OTHER), 1.0, Status.TRACKED)),
        ((OTHER, 0.25), Track(Box(*OTHER), 0.25, Status.TRACKED)),
        (Track(Box(*OTHER), 0.5, Status.OCCLUDED), Track(Box(*OTHER), 0.5, Status.OCCLUDED)),
        ((np.False_, OTHER), Track(FIRST, 0.0, Status.LOST)),
        ((False, None), Track(FIRST, 0.0, Status.LOST)),
        ((0, 0, 0, 0), Track(FIRST, 0.0, Status.LOST)),
        (None, Track(FIRST, 0.0, Status.LOST)),
        ((1, 2, float("nan"), 4), Track(FIRST, 0.0, Status.LOST)),
        ((float("-inf"), 2, 3, 4), Track(FIRST, 0.0, Status.LOST)),
        ((np.full(4, np.nan), 0.5), Track(FIRST, 0.0, Status.LOST)),
        ((True, np.full(4, np.inf)), Track(FIRST, 0.0, Status.LOST)),
    ],
)
def test_answers(answer, track) -> None:
    """It proves what the usual answers of others' trackers mean."""
    tracker = adapt_class(Says)(answer=answer)
    assert tracker.init(PIXELS, FIRST) == Track(FIRST, 1.0, Status.TRACKED)
    assert tracker.update(PIXELS) == track


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        ("left", "update: expected a Track, .* got 'left'"),
        (5, "update: expected a Track, .* got 5"),
        ((1, 2, 3), "expected four numbers"),
        (Track(Box(1, 2, float("nan"), 3), 1.0, Status.TRACKED), "expected finite numbers"),
        ((OTHER, None), "expected a finite score, got None"),
        ((OTHER, float("nan")), "expected a finite score, got nan"),
        ({"box": OTHER}, "update: expected a Track"),
        (Track(Box(1, 2, -3, 4), 1.0, Status.TRACKED), "expected width and height above 0"),
        (Track(Box(*OTHER), float("inf"), Status.TRACKED), "expected a finite score, got inf"),
    ],
)
def test_nonsense(answer, message) -> None:
    """It proves that anything else is an error that shows it."""
    tracker = adapt_class(Says)(answer=answer)
    tracker.init(PIXELS, FIRST)
    with pytest.raises(ValueError, match=message):
        tracker.update(PIXELS)


def test_numbers_that_are_not_known() -> None:
    """It proves what files and pictures get where a third party's track has numbers that aren't finite, and
    that any other track is left as it is.
    """
    whole = Track(Box(*OTHER), 0.5, Status.TRACKED, np.ones(3), np.eye(3), 1.0)
    assert with_known_numbers(whole, Box(*FIRST)) is whole
    place, covariance = np.full(3, np.inf), np.full((3, 3), np.nan)
    unknown = Track(Box(1, float("nan"), 3, 4), 0.0, Status.LOST, place, covariance, np.nan)
    assert with_known_numbers(unknown, Box(*FIRST)) == Track(Box(*FIRST), 0.0, Status.LOST)
    plain = Track(Box(*OTHER), 0.5, Status.TRACKED, (1.0, 2.0, 3.0))  # type: ignore[arg-type]
    assert np.array_equal(with_known_numbers(plain, Box(*FIRST)).position, [1.0, 2.0, 3.0])


def test_a_seed_is_for_those_who_take_one() -> None:
    """It proves that a class with a keyword ``seed`` gets it, and counts as random; others don't."""
    assert adapt_class(Says).traits.random
    assert adapt_class(Says)(seed=7).tracker.seed == 7
    assert not adapt_class(Plain).traits.random


def test_a_file(tmp_path) -> None:
    """It proves that a class of a file is a tracker, and that the file may import what is beside it."""
    (tmp_path / "beside_it.py").write_text("BOX = (3, 4, 5, 6)\n")
    (tmp_path / "one_of_mine.py").write_text(
        "import beside_it\nclass Mine:\n"
        "    def init(self, image, box): pass\n"
        "    def update(self, image): return beside_it.BOX\n"
    )
    tracker = create(f"{tmp_path / 'one_of_mine.py'}:Mine")
    tracker.init(PIXELS, FIRST)
    assert tracker.update(PIXELS).box == OTHER
    with pytest.raises(ValueError, match=r"the file .*one_of_mine.py has no Yours"):
        create(f"{tmp_path / 'one_of_mine.py'}:Yours")
    with pytest.raises(FileNotFoundError, match="no such file"):
        create(f"{tmp_path / 'none_of_mine.py'}:Mine")


class Counting:
    """A third party's with a state of its own, which it changes."""

    def init(self, image, box) -> None:
        self.box, self.counts = box, [0]

    def update(self, image) -> tuple[float, ...]:
        self.counts.append(len(self.counts))
        return (float(len(self.counts)), *self.box[1:])


def test_copies_are_independent() -> None:
    """It proves that a copy goes on by itself, as a copy of one of tricue's trackers does."""
    tracker = adapt_class(Counting)()
    tracker.init(PIXELS, (1, 2, 3, 4))
    tracker.update(PIXELS)
    other = copy.copy(tracker)
    assert [other.update(PIXELS).box.x for _ in range(3)] == [3, 4, 5]
    assert tracker.update(PIXELS).box.x == 3
