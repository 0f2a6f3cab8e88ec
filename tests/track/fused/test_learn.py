# SPDX-License-Identifier: MIT
"""When a target's appearance is learned, and that the place which is learned doesn't drift from the first."""

from types import SimpleNamespace

import numpy as np
import pytest
from tricue.camera.frame import Frame
from tricue.track.fused.learn import MAX_DRIFT, MIN_FIRST_RESPONSE, rate_over, without_drift
from tricue.track.fused.target import Target
from tricue.track.fused.tracker import FusedTracker
from tricue.track.fused.window import CELL_PIXELS, WINDOW_CELLS

PIXEL_SIZE = 1.5
CELL = CELL_PIXELS * PIXEL_SIZE
FOUND = (2.0, -1.0)  # cells from the window's center
TARGET = Target(80.0, 60.0, 30.0, 40.0)


def match(kernels, right, down, height=1.0):
    """A match at FOUND, and the first frame's filter with a peak so many cells from it."""
    cells = np.arange(WINDOW_CELLS) - WINDOW_CELLS // 2
    across, along = cells - FOUND[0] - right, cells[:, None] - FOUND[1] - down
    responses = (height * np.exp(-0.5 * (across**2 + along**2))).astype(np.float32)
    observation = SimpleNamespace(k=kernels, shape=(120, 160))
    window = SimpleNamespace(observation=observation, pixel_size=PIXEL_SIZE, target=TARGET)
    places = {"right": CELL_PIXELS * FOUND[0], "down": CELL_PIXELS * FOUND[1]}
    candidate = SimpleNamespace(window=window, first_responses=responses, **places)
    return SimpleNamespace(candidate=candidate)


@pytest.mark.parametrize(("right", "down"), [(0.3, -0.2), (-0.4, 0.1), (0.0, 0.0)])
def test_the_first_filters_peak_is_taken(kernels, right, down):
    """A target that was found a little beside it moves to that peak, to a tenth of a cell; its size stays."""
    moved = without_drift(TARGET, match(kernels, right, down))
    assert moved.x - TARGET.x == pytest.approx(CELL * right, abs=0.1 * CELL)
    assert moved.y - TARGET.y == pytest.approx(CELL * down, abs=0.1 * CELL)
    assert moved[2:] == TARGET[2:]


@pytest.mark.parametrize(("right", "down"), [(MAX_DRIFT + 0.2, 0.0), (0.0, -MAX_DRIFT - 0.2), (5.0, 5.0)])
def test_a_peak_farther_off_is_not(kernels, right, down):
    """What is farther off is no drift: the target stays."""
    assert without_drift(TARGET, match(kernels, right, down)) is TARGET


def test_a_low_peak_is_not(kernels):
    """Where the first frame's filter hardly responds, it tells nothing."""
    assert without_drift(TARGET, match(kernels, 0.3, 0.0, 1.2 * MIN_FIRST_RESPONSE)) is not TARGET
    assert without_drift(TARGET, match(kernels, 0.3, 0.0, 0.8 * MIN_FIRST_RESPONSE)) is TARGET


def test_the_center_stays_in_the_image(kernels):
    """A target at the border isn't moved out."""
    corner = Target(160.0, 0.0, 30.0, 40.0)
    assert without_drift(corner, match(kernels, 0.4, -0.4))[:2] == (160.0, 0.0)


@pytest.mark.parametrize(
    ("rate", "every"), [(60, 6), (30, 3), (25, 3), (24, 3), (15, 2), (10, 1), (4, 1), (None, 3)]
)
def test_appearance_is_learned_ten_times_a_second(patrol, rate, every):
    """At most: in each frame of slow video, in every third without times, which is taken for 30 frames/s."""
    frames, boxes = patrol
    shown = [Frame(frame.color, timestamp=rate and index / rate) for index, frame in enumerate(frames[:13])]
    tracker = FusedTracker()
    tracker.init(shown[0], boxes[0])
    learned = [0]
    for frame in shown[1:]:
        tracker.update(frame)
        learned.append(tracker._state.appearance_updates)
    assert learned == [index // every for index in range(13)]


def test_unsteady_times_make_no_difference(patrol):
    """A clock that is a tenth of a frame off learns as often as one that isn't."""
    frames, boxes = patrol
    errors = np.random.default_rng(0).uniform(-0.1, 0.1, len(frames))
    tracker = FusedTracker()
    tracker.init(Frame(frames[0].color, timestamp=0.0), boxes[0])
    for index, frame in enumerate(frames[1:], 1):
        tracker.update(Frame(frame.color, timestamp=(index + errors[index]) / 30))
    assert tracker._state.appearance_updates == (len(frames) - 1) // 3


@pytest.mark.parametrize("rate", [0.0, 0.025, 0.5])
def test_rates_add_up(rate):
    """Two steps of learning are as much as one over the time of both; a frame's is the given one."""
    assert rate_over(1 / 30, rate) == pytest.approx(rate)
    assert 1 - (1 - rate_over(0.04, rate)) * (1 - rate_over(0.06, rate)) == pytest.approx(
        rate_over(0.1, rate)
    )


def test_a_number_of_frames_is_deprecated():
    """As 0.1.0 took it: frames at 30 frames/s."""
    with pytest.warns(DeprecationWarning, match=r"learn_every: .* 0.1 instead of 3"):
        assert FusedTracker.Params(learn_every=3).learn_every == pytest.approx(0.1)
