# SPDX-License-Identifier: MIT
"""Targets that turn in the picture's plane."""

import math

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Frame, FusedTracker, Intrinsics, Status
from tricue import kernels as kernel_sets
from tricue.track.fused.experts.turn import TurnExpert
from tricue.track.fused.models import AppearanceModels
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.target import TURN_STEPS, Target
from tricue.track.fused.window import extract_window

Image = NDArray[np.uint8]

CAMERA = Intrinsics.from_fov(320, 240, 60)
TARGET = Target(160.0, 120.0, 50.0, 64.0)
P = FusedTracker.Params()
STEPS_PER_DEGREE = TURN_STEPS / 360


def noise(height: int, width: int, seed: int) -> Image:
    """Smooth blobs of color, some 10 px wide."""
    small = np.random.default_rng(seed).integers(0, 256, (height // 10, width // 10, 3)).astype(np.uint8)
    return np.asarray(cv2.resize(small, (width, height), interpolation=cv2.INTER_CUBIC), np.uint8)


GROUND, CARD = noise(240, 320, 5) // 2 + 60, noise(64, 50, 6)


def picture(degrees: float, x: float = 160.0, y: float = 120.0) -> Image:
    """A card of 50x64 pixels around (x, y), turned clockwise, before a ground that isn't."""
    cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    to_image = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0]])
    to_image[:, 2] = np.array([x - 0.5, y - 0.5]) - to_image[:, :2] @ [24.5, 31.5]
    card, inside = (
        cv2.warpAffine(each, to_image, (320, 240)) for each in (CARD, np.full((64, 50), 255, np.uint8))
    )
    share = inside[..., None] / 255
    return np.round(share * card + (1 - share) * GROUND).astype(np.uint8)


def scene(degrees: float) -> Image:
    """The ground, turned clockwise around the target's center, as by a camera that rolls."""
    turned = cv2.warpAffine(GROUND, cv2.getRotationMatrix2D((159.5, 119.5), -degrees, 1.0), (320, 240))
    return np.asarray(turned, np.uint8)


def observation(image: Image) -> PictureObservation:
    """What experts read of a color image."""
    return PictureObservation(kernel_sets.load("native"), image, CAMERA, None, None)


def models(tracker: FusedTracker) -> AppearanceModels:
    """What it knows of the target in pictures of color."""
    assert tracker._state is not None
    return tracker._state.models["color"]


@pytest.mark.parametrize("per_frame", [1.0, 4.0, -8.0])
def test_a_full_turn_is_followed(per_frame: float) -> None:
    """A card that turns all the way round keeps its middle and is TRACKED; its turn is known to 8 degrees, by
    which it is behind a slow turn.
    """
    tracker = FusedTracker()
    tracker.init(Frame(picture(0.0)), TARGET.box)
    for number in range(1, round(360 / abs(per_frame)) + 1):
        x, degrees = 160 + 20 * math.sin(number / 20), number * per_frame
        track = tracker.update(Frame(picture(degrees, x)))
        assert track.status is Status.TRACKED
        assert track.box.center == pytest.approx((x, 120), abs=4)
        assert tracker._state is not None
        found = tracker._state.target.turn / STEPS_PER_DEGREE
        assert abs(math.remainder(found - degrees, 360)) < 8


def test_box_holds_the_turned_target() -> None:
    """Turned by a quarter the box is as wide as it was high; without the cue it stays as it was."""
    boxes = {}
    for cues in (P.cues, ("filter", "color", "size")):
        tracker = FusedTracker(cues=cues)
        tracker.init(Frame(picture(0.0)), TARGET.box)
        for degrees in range(0, 94, 3):
            boxes[cues] = tracker.update(Frame(picture(min(degrees, 90)))).box
    assert boxes[P.cues].width / boxes[P.cues].height == pytest.approx(64 / 50, rel=0.03)
    assert boxes["filter", "color", "size"].width < boxes["filter", "color", "size"].height


def test_upright_targets_stay_upright() -> None:
    """A card that goes and never turns is turned by less than two degrees in any frame."""
    tracker = FusedTracker()
    tracker.init(Frame(picture(0.0)), TARGET.box)
    for number in range(60):
        tracker.update(Frame(picture(0.0, 160 + 50 * math.sin(number / 10), 120 + number / 4)))
        assert tracker._state is not None
        assert abs(tracker._state.target.turn) < 2 * STEPS_PER_DEGREE


def test_with_depth_it_is_upright() -> None:
    """Frames with depth don't turn the target, and set one upright that color alone has turned."""
    tracker, depth = FusedTracker(), np.full((240, 320), 2.0, np.float32)
    tracker.init(Frame(picture(0.0)), TARGET.box)
    for degrees in range(0, 31, 3):
        tracker.update(Frame(picture(degrees)))
    assert tracker._state is not None
    assert tracker._state.target.turn > 20 * STEPS_PER_DEGREE
    tracker.update(Frame(picture(30), depth=depth))
    assert tracker._state.target.turn == 0


@pytest.mark.parametrize("degrees", [-15.0, -6.0, 0.0, 3.0, 12.0])
@pytest.mark.parametrize("before", [0, 200])
def test_expert_tells_the_turn(degrees: float, before: int) -> None:
    """Learned of one frame it tells two fifths to all of the turn of the whole scene in the next one,
    whatever it was before, and the rest in the frames to come: as with sizes, samples that share a pixel
    speak for the turn as it is.
    """
    start = before / STEPS_PER_DEGREE
    params = FusedTracker.Params(turn_back=0.0)
    expert = TurnExpert.from_target(observation(scene(start)), TARGET._replace(turn=before), params)
    seen, target = observation(scene(start + degrees)), TARGET._replace(turn=before)
    found = expert.turn(seen, target) / STEPS_PER_DEGREE
    assert min(0.4 * degrees, degrees) - 0.3 <= found <= max(0.4 * degrees, degrees) + 0.3
    for _ in range(8):
        target = target.turn_by(expert.turn(seen, target))
    assert (target.turn - before) / STEPS_PER_DEGREE == pytest.approx(degrees, abs=1.5)


def test_what_is_turned_back_is_bounded() -> None:
    """Of a turn seen nowhere, a tenth goes back in a frame, and of a large one a tenth of 11.25 degrees."""
    flat = observation(np.full((240, 320, 3), 90, np.uint8))
    expert = TurnExpert.from_target(flat, TARGET, P)
    for degrees, back in ((0, 0.0), (8, 0.8), (-8, -0.8), (90, 1.125), (-170, -1.125)):
        turned = TARGET.turn_by(degrees * STEPS_PER_DEGREE)
        assert expert.turn(flat, turned) / STEPS_PER_DEGREE == pytest.approx(-back, abs=0.02)


@pytest.mark.parametrize("quarters", [1, 2, 3])
def test_turned_window_is_that_of_a_turned_picture(quarters: int) -> None:
    """Turned by quarters with the picture, a window has nearly the same pixels."""
    image = noise(240, 240, 7)
    turned = np.ascontiguousarray(np.rot90(image, -quarters))
    target = Target(120.0, 120.0, 40.0, 30.0)
    windows = (
        extract_window(observation(seen), each, 3.0).patch.astype(int)
        for seen, each in ((image, target), (turned, target.turn_by(quarters * TURN_STEPS / 4)))
    )
    upright, found = windows
    assert np.abs(upright - found).mean() < 6
    assert np.abs(upright - np.rot90(found, 1)).mean() > 20


def test_turn_is_learned_every_other_time() -> None:
    """Of a target that is followed the filter of its size changes in every third frame, that of its turn in
    every sixth.
    """
    tracker = FusedTracker()
    tracker.init(picture(0), box=TARGET.box)
    learned = []
    for _ in range(12):
        before = models(tracker)
        tracker.update(picture(0))
        after = models(tracker)
        learned.append((after.size is not before.size, after.turn is not before.turn))
    frames = range(1, 13)
    assert learned == [(frame % 3 == 0, frame % 6 == 0) for frame in frames]


def test_turns_go_round() -> None:
    """Turns by small steps add up to a full one, which is none; a turn by half is the farthest."""
    target = TARGET
    for _ in range(TURN_STEPS):
        target = target.turn_by(1.0)
        assert -TURN_STEPS // 2 <= target.turn < TURN_STEPS // 2
    assert target == TARGET
    assert TARGET.turn_by(0.4) == TARGET


def test_upright_box_of_an_ellipse() -> None:
    """Upright it holds the ellipse of the turned one: the same at a half turn, its sides changed at a
    quarter, in between the bounds of the ellipse's points.
    """
    assert TARGET.turn_by(TURN_STEPS / 2).upright == pytest.approx(TARGET)
    quarter = TARGET.turn_by(TURN_STEPS / 4).upright
    assert (quarter.width, quarter.height) == pytest.approx((TARGET.height, TARGET.width))
    turned = TARGET.turn_by(100)
    angles = np.linspace(0, 2 * np.pi, 10_000)
    points = [turned.along(25 * math.cos(a), 32 * math.sin(a)) for a in angles]
    x, y = np.array(points).T
    assert np.ptp(x) == pytest.approx(turned.upright.width, abs=0.01)
    assert np.ptp(y) == pytest.approx(turned.upright.height, abs=0.01)
