# SPDX-License-Identifier: MIT
import numpy as np
import pytest

from benchmarks.quality.common import depth_alignment

HEIGHT, WIDTH = 180, 240


def board(left, top, near=1.0, far=2.5):
    """Depth of a board of 90x80 pixels before a wall."""
    depth = np.full((HEIGHT, WIDTH), far)
    depth[top : top + 80, left : left + 90] = near
    return depth


def picture(left, top, seed=0):
    """Its brightness, with noise."""
    gray = np.full((HEIGHT, WIDTH), 90.0) + np.random.default_rng(seed).normal(0, 3, (HEIGHT, WIDTH))
    gray[top : top + 80, left : left + 90] += 80
    return gray.clip(0, 255).astype(np.uint8)


@pytest.mark.parametrize("shift", [(0, 0), (3, -2), (-4, 1)])
def test_shift_between_edges(monkeypatch, shift):
    """The shift that lays the depth's edges on the color's, to a pixel, in each part that has corners."""
    monkeypatch.setattr(depth_alignment, "BLOCKS", (1, 1))
    edges = depth_alignment.find_edges(board(70, 50))
    slopes = depth_alignment.gradient(picture(70 + shift[0], 50 + shift[1]))
    ((x, y),) = depth_alignment.shifts(edges, slopes)
    assert (abs(x - shift[0]) <= 1, abs(y - shift[1]) <= 1) == (True, True)


def test_without_matching_edges_there_is_no_shift():
    """Where color has no edges, none is told."""
    edges = depth_alignment.find_edges(board(70, 50))
    empty = np.random.default_rng(0).normal(90, 3, (HEIGHT, WIDTH)).astype(np.uint8)
    assert depth_alignment.shifts(edges, depth_alignment.gradient(empty)).shape == (0, 2)


@pytest.mark.parametrize("late", [0, 1, -1])
def test_delay_of_a_moving_board(late):
    """Depth of a board that moves over 12 pixels a frame, a frame late or early, or in time."""
    lefts = [10 + 12 * index for index in range(11)]
    seen = [min(max(index - late, 0), 10) for index in range(11)]
    edges = [depth_alignment.find_edges(board(lefts[index], 50)) for index in seen]
    slopes = [depth_alignment.gradient(picture(left, 50, seed)) for seed, left in enumerate(lefts)]
    assert depth_alignment.delay(edges, slopes) == pytest.approx(late, abs=0.3)


def test_no_delay_is_told_of_what_has_no_edges():
    """Without edges, or with fewer frames than the lags take, the delay is unknown."""
    flat = depth_alignment.find_edges(np.full((HEIGHT, WIDTH), 2.0))
    slopes = depth_alignment.gradient(picture(70, 50))
    assert np.isnan(depth_alignment.delay([flat] * 9, [slopes] * 9))
    assert np.isnan(depth_alignment.delay([depth_alignment.find_edges(board(70, 50))] * 4, [slopes] * 4))
