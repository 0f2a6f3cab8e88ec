# SPDX-License-Identifier: MIT
"""Depth that can't be believed is told of once and left out; the target is followed by color."""

import copy
import pickle
import warnings
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Frame, FusedTracker, Status, Track
from tricue.track.fused.depth_trust import MIN_FROZEN_FRAMES

WIDTH, HEIGHT, SIDE = 160, 120, 36
BOX = (60, 40, SIDE, SIDE)
QUIET = pytest.mark.filterwarnings("ignore:depth. its median")  # what the frame itself tells


def texture(height: int, width: int, seed: int) -> NDArray[np.uint8]:
    """Grain of five pixels, BGR."""
    coarse = np.random.default_rng(seed).integers(0, 256, (height // 5 + 1, width // 5 + 1, 3), np.uint8)
    return np.asarray(cv2.resize(coarse, (width, height), interpolation=cv2.INTER_CUBIC), np.uint8)


WALL, TARGET = texture(HEIGHT, WIDTH, 0), texture(SIDE, SIDE, 1)


def color_at(shift: int) -> NDArray[np.uint8]:
    """A card before a wall, so many pixels to the right."""
    image = WALL.copy()
    image[40 : 40 + SIDE, 60 + shift : 60 + shift + SIDE] = TARGET
    return image


def depth_at(shift: int) -> NDArray[np.float32]:
    """Its depth, meters, without noise."""
    depth = np.full((HEIGHT, WIDTH), 4, np.float32)
    depth[40 : 40 + SIDE, 60 + shift : 60 + shift + SIDE] = 2
    return depth


def frame(shift: int, scale: float = 1.0, depth: int | None = None, **others: Any) -> Frame:
    """Color and depth, which is as of another shift where one is given."""
    return Frame(color_at(shift), scale * depth_at(shift if depth is None else depth), **others)


def told(caught: list[warnings.WarningMessage]) -> list[str]:
    """The trackers' messages."""
    return [str(each.message) for each in caught if str(each.message).startswith("frame.depth")]


def follow(tracker: FusedTracker, frames: list[Frame]) -> tuple[list[Track], list[str]]:
    """The tracks, and what was told of depth."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        tracks = [tracker.update(each) for each in frames]
    return tracks, told(caught)


def started(first: Frame | None = None, **values: Any) -> FusedTracker:
    """A tracker of the card that has seen one frame."""
    tracker = FusedTracker(**values)
    tracker.init(first or frame(0), BOX)
    return tracker


@QUIET
@pytest.mark.parametrize(
    ("scale", "words"),
    [
        (1000, r"expected meters, got 2000 to 4000, .* millimeters; .*depth_scale=0.001"),
        (0.001, r"expected meters, got 0.002 to 0.004, .* read as millimeters; .*depth_scale=1 "),
    ],
)
def test_another_unit_is_left_out(scale: float, words: str) -> None:
    """It proves that depth in another unit is told of once, from where the tracker was called, and then
    changes nothing: the tracks are those of color alone.
    """
    tracker, by_color, bad = FusedTracker(), FusedTracker(), frame(0, scale)
    with pytest.warns(UserWarning, match=f"^frame.depth: {words}") as caught:
        first = tracker.init(bad, BOX)
    assert len(caught) == 1
    assert caught[0].filename == __file__
    assert first == by_color.init(Frame(color_at(0)), BOX)
    tracks, messages = follow(tracker, [frame(shift, scale) for shift in range(1, 8)])
    assert messages == []
    assert tracks == [by_color.update(Frame(color_at(shift))) for shift in range(1, 8)]
    assert tracks[-1].status is Status.TRACKED


@QUIET
def test_another_unit_later_is_left_out() -> None:
    """It proves that it is told of when it comes, and depth is used again once it is in meters."""
    tracker, bad = started(), frame(1, 1000)
    with pytest.warns(UserWarning, match="^frame.depth: expected meters") as caught:
        tracker.update(bad)
    assert caught[0].filename == __file__
    tracks, messages = follow(tracker, [frame(2, 1000), frame(3), frame(4)])
    assert messages == []
    assert tracks[-1].position is not None
    assert tracks[-1].position[2] == pytest.approx(2, abs=0.05)


@QUIET
@pytest.mark.parametrize("scale", [1000, 0.001, 1e-45])
def test_another_unit_without_color_is_an_error(scale: float) -> None:
    """It proves that init and update refuse it by name, and the tracker goes on as if it had not come."""
    depth = np.maximum(np.float32(scale) * depth_at(1), np.float32(1e-45))
    tracker = started(Frame(depth=depth_at(0)))
    expected = copy.deepcopy(tracker).update(Frame(depth=depth_at(1)))
    for call in (lambda bad: tracker.init(bad, BOX), tracker.update):
        with pytest.raises(ValueError, match=r"^frame.depth: expected meters, got .*depth_scale="):
            call(Frame(depth=depth))
    assert tracker.update(Frame(depth=depth_at(1))) == expected


@QUIET
def test_depth_that_is_not_read_is_not_doubted() -> None:
    """It proves that nothing is said of depth without the cue depth."""
    tracker = FusedTracker(cues=("filter", "color", "size"))
    frames = [frame(shift, 1000) for shift in range(3)]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tracker.init(frames[0], BOX)
        tracker.update(frames[1])


@pytest.mark.parametrize("depth", [0.02, 60.0])
@QUIET
def test_unusual_depths_are_believed(depth: float) -> None:
    """It proves that depth of 2 cm or 60 m isn't called another unit."""
    frames = [Frame(color_at(shift), np.full((HEIGHT, WIDTH), depth, np.float32)) for shift in range(3)]
    assert follow(started(frames[0]), frames[1:])[1] == []


def test_frozen_depth_is_left_out() -> None:
    """It proves that depth that stands still for half a second while the target moves is told of once, that
    the target is followed all the same, and that depth is used again once it changes.
    """
    tracker = started()
    tracks, messages = follow(tracker, [frame(shift, depth=0) for shift in range(1, 1 + MIN_FROZEN_FRAMES)])
    assert len(messages) == 1
    assert f"got the same image for {MIN_FROZEN_FRAMES + 1} frames, while color changed" in messages[0]
    further = range(1 + MIN_FROZEN_FRAMES, 40)
    tracks, messages = follow(tracker, [frame(shift, depth=0) for shift in further])
    assert messages == []
    assert tracks[-1].status is Status.TRACKED
    assert tracks[-1].box.iou(Box(60 + 39, *BOX[1:])) > 0.7
    tracks, messages = follow(tracker, [frame(shift) for shift in range(40, 50)])
    assert messages == []
    assert tracks[-1].position is not None
    assert tracks[-1].position[2] == pytest.approx(2, abs=0.1)


def test_frozen_depth_changes_nothing() -> None:
    """It proves that once it is told of, the track is that of color alone."""
    tracker = started()
    follow(tracker, [frame(shift, depth=0) for shift in range(1, 20)])
    assert copy.deepcopy(tracker).update(frame(20, depth=0)) == tracker.update(Frame(color_at(20)))


@pytest.mark.parametrize(
    ("frames", "why"),
    [
        ([frame(shift // 9) for shift in range(60)], "a target that moves so slowly that samples miss it"),
        ([frame(0)] * 60, "nothing moves"),
        ([frame(shift, depth=shift // 10 * 10) for shift in range(45)], "a slow depth camera"),
        ([frame(shift, depth=0, timestamp=shift / 100) for shift in range(45)], "a fast color camera"),
        ([Frame(depth=depth_at(0))] * 60, "no color"),
        (
            [Frame(color_at(shift), np.full((HEIGHT, WIDTH), np.nan, np.float32)) for shift in range(45)],
            "nothing measured",
        ),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_depth_that_may_stand_still_is_believed(frames: list[Frame], why: str) -> None:
    """It proves that equal depth alone isn't doubted, nor for a moment."""
    assert follow(started(frames[0]), frames[1:])[1] == [], why


def test_noise_is_no_motion() -> None:
    """It proves that a still scene whose color is noisy and whose depth isn't is believed."""
    rng = np.random.default_rng(0)
    noisy = [np.clip(color_at(0) + rng.normal(0, 5, WALL.shape), 0, 255).astype(np.uint8) for _ in range(40)]
    frames = [Frame(image, depth_at(0)) for image in noisy]
    assert follow(started(frames[0]), frames[1:])[1] == []


def test_copies_and_pickles_remember() -> None:
    """It proves that what is remembered of depth goes with the tracker, and nobody shares it."""
    tracker = started()
    follow(tracker, [frame(shift, depth=0) for shift in range(1, MIN_FROZEN_FRAMES)])
    for other in (pickle.loads(pickle.dumps(tracker)), copy.copy(tracker), copy.deepcopy(tracker), tracker):
        assert len(follow(other, [frame(MIN_FROZEN_FRAMES, depth=0)])[1]) == 1


def test_a_warning_made_an_error_leaves_the_tracker() -> None:
    """It proves that the memory is kept with the state alone: what raised is told of again."""
    tracker = started()
    follow(tracker, [frame(shift, depth=0) for shift in range(1, MIN_FROZEN_FRAMES)])
    before = pickle.dumps(tracker)
    for _ in range(2):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with pytest.raises(UserWarning, match="the same image"):
                tracker.update(frame(MIN_FROZEN_FRAMES, depth=0))
        assert pickle.dumps(tracker) == before


def test_unregistered_depth_is_told_of_and_used() -> None:
    """It proves that init warns of shifted depth, from where it was called, and goes on with it."""
    rng = np.random.default_rng(0)
    color, depth = np.full((240, 320, 3), 110, np.uint8), np.full((240, 320), 4, np.float32)
    for _ in range(12):
        x, y, wide, high = (int(rng.integers(*span)) for span in ((20, 240), (20, 160), (20, 60), (20, 60)))
        color[y : y + high, x : x + wide] = rng.integers(0, 256, 3)
        depth[y : y + high, x : x + wide] = rng.uniform(1, 3)
    box = (x, y, wide, high)
    tracker = FusedTracker()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        tracker.init(Frame(color, depth), box)
    with pytest.warns(UserWarning, match=r"^depth: seems not .* about 10 px .* by \(-10, 0\) px") as caught:
        track = tracker.init(Frame(color, np.roll(depth, 10, axis=1)), box)
    assert [each.filename for each in caught] == [__file__]
    assert track.position is not None


@pytest.mark.parametrize("call", ["init", "update"])
def test_another_size_says_what_to_do(call: str) -> None:
    """It proves that depth of another size than color is an error that names the ways out."""
    tracker = started()
    bad = Frame(color_at(1), depth_at(1)[::2, ::2])
    words = r"got \(60, 80\); .*registration.Registration .*cv2.resize\(depth, \(160, 120\), "
    with pytest.raises(ValueError, match=words):
        tracker.init(bad, BOX) if call == "init" else tracker.update(bad)
