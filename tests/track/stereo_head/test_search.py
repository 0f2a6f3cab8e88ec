# SPDX-License-Identifier: MIT
"""That the search finds the place most like the model, by color and depth, and learns what is the head's."""

import numpy as np
import pytest
from tricue import StereoHeadTracker
from tricue.track.stereo_head.search import LEAST, best_place, first_histogram, histogram_of, in_places, score
from tricue.track.stereo_head.view import View

Params = StereoHeadTracker.Params
P = Params(bins=(2, 2, 1), ring=1.5)
SIZE = 4
SKIN, HAIR, WALL = 0, 1, 2
ELLIPSE = (30.0, 24.0, 6.0, 8.0)


def inside(ellipse: tuple[float, ...], shape: tuple[int, int]) -> np.ndarray:
    """The pixels (h, w) whose centres are in an ellipse."""
    x, y, minor, major = ellipse
    rows, columns = np.indices(shape) + 0.5
    return ((columns - x) / minor) ** 2 + ((rows - y) / major) ** 2 < 1


def scene(ellipse: tuple[float, ...] = ELLIPSE, left: int = 0, top: int = 0) -> View:
    """A wall, and before it a head of skin at its depth."""
    head = inside(ellipse, (48, 60))
    return View(left, top, np.where(head, SKIN, WALL).astype(np.uint16), head.astype(np.uint8))


def model(*shares: float) -> np.ndarray:
    """A histogram of skin, hair, wall and nothing else."""
    return np.array([*shares, 0.0])


ALL_SKIN = model(1, 0, 0)


@pytest.mark.parametrize("weights", [(0.6, 0.4, 0.5), (0, 0, 0), (0.5, 0.5, 0.5)], ids=str)
def test_the_score_is_its_formula(weights):
    """A place counts phi - w phi(ring) + v (coherent - r coherent(ring)), for any number of places; with
    weights of 0 it is (1) alone.
    """
    around, depth, behind = weights
    p = Params(ring_weight=around, depth_weight=depth, depth_ring=behind)
    four = np.random.default_rng(0).random((3, 5, 4))
    expected = four[..., 0] - around * four[..., 1] + depth * (four[..., 2] - behind * four[..., 3])
    np.testing.assert_allclose(score(four, p), expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("form", [{}, {"ring_weight": 0, "depth_weight": 0}], ids=["usual", "printed"])
@pytest.mark.parametrize("off", [(0, 0), (8, 4), (-8, -4), (5, -3), (-1, 2)], ids=str)
def test_a_moved_head_is_found(off, form, kernels):
    """A head that has moved by whole places within the search is found at its very place, with a full
    intersection, and all of it coherent.
    """
    p = Params(bins=P.bins, **form)
    moved = (ELLIPSE[0] + off[0], ELLIPSE[1] + off[1], *ELLIPSE[2:])
    place = best_place(kernels, scene(moved), ELLIPSE, ALL_SKIN, 1, P.search, p)
    assert place.ellipse == moved
    assert place.intersection == 1
    assert place.coherence == 1


@pytest.mark.parametrize("step", [2, 4])
def test_places_are_steps_of_pixels(step, kernels):
    """With every step-th pixel a place, the ellipse found is in pixels, and moves by whole steps."""
    moved = (ELLIPSE[0] + 3, ELLIPSE[1] - 2, *ELLIPSE[2:])
    view = scene(moved, left=-5, top=7)
    pixels = tuple(step * np.array([ELLIPSE[0] + view.left, ELLIPSE[1] + view.top, *ELLIPSE[2:]]))
    np.testing.assert_allclose(in_places(pixels, view, step), ELLIPSE, rtol=1e-14)
    place = best_place(kernels, view, pixels, ALL_SKIN, step, P.search, P)
    assert place.ellipse == (pixels[0] + 3 * step, pixels[1] - 2 * step, *pixels[2:])


@pytest.mark.parametrize("search", [(0, 0), (3, 0), (0, 2), (2, 1)], ids=str)
def test_the_search_goes_no_farther_than_told(search, kernels):
    """A head out of reach is approached as far as the search goes."""
    far = (ELLIPSE[0] + 6, ELLIPSE[1] + 5, *ELLIPSE[2:])
    place = best_place(kernels, scene(far), ELLIPSE, ALL_SKIN, 1, search, P)
    assert place.ellipse == (ELLIPSE[0] + search[0], ELLIPSE[1] + search[1], *ELLIPSE[2:])


def test_depth_decides_between_equal_colors(kernels):
    """Of two heads of one color the one at the expected depth is taken; by color alone it may be either."""
    one, other = (22.0, 24.0, 6.0, 8.0), (38.0, 24.0, 6.0, 8.0)
    pair = inside(one, (48, 60)) | inside(other, (48, 60))
    bins = np.where(pair, SKIN, WALL).astype(np.uint16)
    for chosen in (one, other):
        view = View(0, 0, bins, inside(chosen, bins.shape).astype(np.uint8))
        place = best_place(kernels, view, ELLIPSE, ALL_SKIN, 1, P.search, P)
        assert place.ellipse == chosen


def test_a_surround_of_the_same_color_counts_against(kernels):
    """The ring's weight keeps the ellipse on a patch of its own size: on one color everywhere the score is
    1 - w + v (1 - r).
    """
    view = View(0, 0, np.zeros((48, 60), np.uint16), np.ones((48, 60), np.uint8))
    place = best_place(kernels, view, ELLIPSE, ALL_SKIN, 1, (0, 0), P)
    expected = 1 - P.ring_weight + P.depth_weight * (1 - P.depth_ring)
    assert place.score == pytest.approx(expected, abs=1e-12)


def test_outside_the_picture_is_nothing(kernels):
    """Where no place has a bin score and intersection are 0, no NaN, and its histogram is empty."""
    view = View(0, 0, np.full((48, 60), 65535, np.uint16), np.zeros((48, 60), np.uint8))
    place = best_place(kernels, view, ELLIPSE, ALL_SKIN, 1, P.search, P)
    assert place[1:] == (0, 0, 0)
    assert not histogram_of(kernels, view, ELLIPSE, 1, P).any()


def test_only_the_heads_depth_is_learned(kernels):
    """Of an ellipse half on the wall only the pixels at the head's depth are learned; with learn="all" as
    many of each as there are.
    """
    half = (ELLIPSE[0] + 4, *ELLIPSE[1:])
    view = scene()
    np.testing.assert_array_equal(histogram_of(kernels, view, half, 1, P), model(1, 0, 0))
    seen = inside(half, view.bins.shape)
    skin = np.count_nonzero(seen & (view.bins == SKIN)) / seen.sum()
    everything = histogram_of(kernels, view, half, 1, Params(bins=P.bins, learn="all"))
    np.testing.assert_allclose(everything, model(skin, 0, 1 - skin), rtol=0, atol=1e-15)


@pytest.mark.parametrize("coherent", [0, LEAST - 1, LEAST])
def test_too_few_at_the_depth_are_not_believed(coherent, kernels):
    """With fewer than LEAST pixels at the head's depth all of the ellipse are learned, else these alone."""
    view = scene()
    skin = np.argwhere(view.bins == SKIN)[:coherent]
    view.coherent[:] = 0
    view.coherent[tuple(skin.T)] = 1
    wide = (*ELLIPSE[:2], 9.0, 12.0)
    learned = histogram_of(kernels, view, wide, 1, P)
    assert learned.sum() == pytest.approx(1)
    assert (learned[WALL] == 0) == (coherent >= LEAST)


@pytest.mark.parametrize("hair", [0.0, 0.5, 1.0])
def test_the_first_model_holds_hair(hair, kernels):
    """The model of a start is the ellipse's histogram and its cap's, in the shares told, of sum 1: with hair
    on top alone the share of hair is that of the whole, and ``hair`` of what is missing to the cap's.
    """
    view = scene()
    top = np.indices(view.bins.shape)[0] < 24 - 4  # the cap ends at 24 - 0.4 x 8
    view.bins[top & (view.bins == SKIN)] = HAIR
    found = first_histogram(kernels, view, ELLIPSE, 1, Params(bins=P.bins, hair=hair))
    assert found.shape == (SIZE,)
    assert found.sum() == pytest.approx(1, abs=1e-12)
    head = inside(ELLIPSE, view.bins.shape)
    whole = np.count_nonzero(view.bins[head] == HAIR) / head.sum()
    cap = inside((30.0, 24.0 - 0.7 * 8, 6.0, 0.3 * 8), view.bins.shape) & head
    on_top = np.count_nonzero(view.bins[cap] == HAIR) / cap.sum()
    assert found[HAIR] == pytest.approx((1 - hair) * whole + hair * on_top, abs=1e-12)
