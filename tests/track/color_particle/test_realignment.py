# SPDX-License-Identifier: MIT
"""The first frame's appearance is looked for near the estimate, so that errors of learning don't add up."""

import cv2
import numpy as np
import pytest
from tricue import Box, ColorParticleTracker, kernels
from tricue.evaluation import metrics
from tricue.track.color_particle.appearance import Appearance
from tricue.track.color_particle.realignment import (
    BLOCKS,
    FAR,
    FIRST_LOOK,
    NEAR,
    SCALE,
    WINDOWS,
    moved,
    realign,
)

START = Box(100, 90, 50, 63)
K = kernels.load("native")
PARAMS = ColorParticleTracker.Params()
ELLIPSE = np.array(START.ellipse)


@pytest.fixture(scope="module")
def frame(stage):
    """A face at START."""
    return stage([(START.x, START.y)])[0]


@pytest.fixture(scope="module")
def first(frame):
    """The appearance of that face."""
    empty = Appearance.create(PARAMS)
    return empty.learn(K, frame, ELLIPSE, empty.observe(K, frame, ELLIPSE), 1.0, 1.0)


def overlap(ellipse):
    """Of an ellipse's box with the face."""
    box = Box.from_ellipse(*ellipse.tolist())
    return metrics.overlaps([box], np.array([[START.x, START.y, START.width, START.height]]))[0]


def test_an_estimate_that_is_off_comes_back(frame, first):
    """One look after the other finds the face from all sides, never a place that is less like it."""
    offsets = [(8, 0), (0, -10), (-9, 9), (-8, 2), (5, 5), (4, -8), (0, 10), (-8, -6)]
    ends = []
    for offset in offsets:
        ellipse, before = ELLIPSE + [*offset, 0, 0], -np.inf
        assert overlap(ellipse) < 0.8
        for block in range(2 * BLOCKS):
            found = realign(K, frame, first, ellipse, block)
            assert found.gain >= 0
            assert found.log_likelihood >= before
            ellipse, before = found.ellipse, found.log_likelihood
        ends.append(overlap(ellipse))
    assert min(ends) > 0.85
    assert np.mean(ends) > 0.93


def test_the_estimate_stays_where_the_face_is_not(stage, first):
    """In clutter nothing is better, however often it is looked for."""
    clutter = stage([None])[0]
    for block in range(BLOCKS):
        found = realign(K, clutter, first, ELLIPSE, block)
        assert found.gain == 0
        np.testing.assert_array_equal(found.ellipse, ELLIPSE)


@pytest.mark.parametrize("grows", [False, True])
def test_the_size_stays_in_its_range(grows, stage, follow):
    """The box of a target that shrinks or grows keeps the only size that is allowed."""
    frames = []
    for image, share in zip(stage([(100, 90)] * 30), np.linspace(1, 0.7, 30), strict=True):
        frames.append(np.zeros_like(image))
        small = cv2.resize(image, None, fx=share, fy=share)
        frames[-1][: len(small), : small.shape[1]] = small
    start = START
    if grows:
        frames, start = frames[::-1], Box(*(0.7 * each for each in START))
    for track in follow(ColorParticleTracker(size_range=(1.0, 1.0)), frames, start):
        assert track.box[2:] == pytest.approx(start[2:])


def test_all_particles_move_with_their_estimate(frame, follow):
    """By the same step, but not out of their bounds."""
    tracker = ColorParticleTracker(seed=0)
    follow(tracker, [frame, frame], START)
    particles, appearance = tracker._state.particles, tracker._state.appearance
    step = np.array([6.0, -4.0, 1.0, 1.0])
    bounds = np.array([np.zeros(4), [particles.ellipse[0] + 6.0, 240, 100, 100]])
    after = moved(K, frame, appearance, particles, particles.ellipse + step, bounds)
    np.testing.assert_array_equal(after.ellipse, particles.ellipse + step)
    np.testing.assert_allclose(after.particles[:, 1:], particles.particles[:, 1:] + step[1:])
    assert after.particles[:, 0].max() == bounds[1, 0]
    assert after.log_likelihood == appearance.log_likelihood(K, frame, after.ellipse[None])[0]


def test_blocks_differ():
    """Looks one after the other are at other windows, in turn near and far."""
    offsets = np.stack(FIRST_LOOK)
    assert offsets.shape == (BLOCKS, WINDOWS - 1, 4)
    assert len(np.unique(offsets.reshape(-1, 4), axis=0)) == BLOCKS * (WINDOWS - 1)
    for windows, spread in ((offsets[:, ::2], NEAR), (offsets[:, 1::2], FAR)):
        np.testing.assert_allclose(windows[..., :2].std(axis=(0, 1)), 2 * spread, rtol=0.05)


def test_sizes_are_even():
    """A third of every block's windows is smaller, a third larger, and a third about as large."""
    for offsets in FIRST_LOOK:
        size = np.log(offsets[:, 2]) / SCALE
        thirds = [np.sum(size < -1 / 3**0.5), np.sum(abs(size) <= 1 / 3**0.5), np.sum(size > 1 / 3**0.5)]
        assert min(thirds) >= WINDOWS // 3 - 1
