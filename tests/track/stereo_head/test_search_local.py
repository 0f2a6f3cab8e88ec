# SPDX-License-Identifier: MIT
"""That the local search finds the ellipse most like the model, and that histograms are the head's colors."""

import numpy as np
import pytest
from tricue import StereoHeadTracker
from tricue.kernels import Kernels
from tricue.track.stereo_head.color_model import measure_first_histogram
from tricue.track.stereo_head.search_local import MIN_COHERENT_CELLS, score_matches, search_local
from tricue.track.stereo_head.search_region import SearchRegion

Params = StereoHeadTracker.Params
P = Params(bins=(2, 2, 1), ring=1.5)
SIZE = 4
SKIN, HAIR, WALL = 0, 1, 2
ELLIPSE = (30.0, 24.0, 6.0, 8.0)


def inside(ellipse: tuple[float, ...], shape: tuple[int, int]) -> np.ndarray:
    """The pixels (h, w) whose centers are in an ellipse."""
    x, y, minor, major = ellipse
    rows, columns = np.indices(shape) + 0.5
    return ((columns - x) / minor) ** 2 + ((rows - y) / major) ** 2 < 1


def scene(ellipse: tuple[float, ...] = ELLIPSE, left: int = 0, top: int = 0) -> SearchRegion:
    """A wall, and before it a head of skin at its depth."""
    head = inside(ellipse, (48, 60))
    return SearchRegion(left, top, np.where(head, SKIN, WALL).astype(np.uint16), head.astype(np.uint8))


def model(*shares: float) -> np.ndarray:
    """A histogram of skin, hair, wall and nothing else."""
    return np.array([*shares, 0.0])


ALL_SKIN = model(1, 0, 0)


def colors_of(k: Kernels, region: SearchRegion, ellipse: tuple[float, ...], p: Params = P) -> np.ndarray:
    """(L,) the colors of an ellipse that isn't moved."""
    return search_local(k, region, ellipse, ALL_SKIN, 1, (0, 0), p)[1]


@pytest.mark.parametrize("weights", [(0.6, 0.4, 0.5), (0, 0, 0), (0.5, 0.5, 0.5)], ids=str)
def test_the_score_is_its_formula(weights):
    """The score is phi - w phi(ring) + v (coherent - r coherent(ring)), for any number of matches. With
    weights of 0 it is (1) alone.
    """
    around, depth, behind = weights
    p = Params(ring_weight=around, depth_weight=depth, depth_ring=behind)
    four = np.random.default_rng(0).random((3, 5, 4))
    expected = four[..., 0] - around * four[..., 1] + depth * (four[..., 2] - behind * four[..., 3])
    np.testing.assert_allclose(score_matches(four, p), expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("form", [{}, {"ring_weight": 0, "depth_weight": 0}], ids=["default", "printed"])
@pytest.mark.parametrize("off", [(0, 0), (8, 4), (-8, -4), (5, -3), (-1, 2)], ids=str)
def test_a_moved_head_is_found(off, form, kernels):
    """A head that has moved by whole cells within the search is found exactly there, with a full
    intersection, and all of it coherent.
    """
    p = Params(bins=P.bins, **form)
    moved = (ELLIPSE[0] + off[0], ELLIPSE[1] + off[1], *ELLIPSE[2:])
    match, _ = search_local(kernels, scene(moved), ELLIPSE, ALL_SKIN, 1, P.search, p)
    assert match.ellipse == moved
    assert match.intersection == 1
    assert match.coherence == 1


@pytest.mark.parametrize("step", [2, 4])
def test_cells_are_steps_of_pixels(step, kernels):
    """With cells of step x step pixels, the ellipse found is in pixels, and moves by whole steps."""
    moved = (ELLIPSE[0] + 3, ELLIPSE[1] - 2, *ELLIPSE[2:])
    region = scene(moved, left=-5, top=7)
    pixels = tuple(step * np.array([ELLIPSE[0] + region.left, ELLIPSE[1] + region.top, *ELLIPSE[2:]]))
    np.testing.assert_allclose(region.to_cells(pixels, step), ELLIPSE, rtol=1e-14)
    match, _ = search_local(kernels, region, pixels, ALL_SKIN, step, P.search, P)
    assert match.ellipse == (pixels[0] + 3 * step, pixels[1] - 2 * step, *pixels[2:])


@pytest.mark.parametrize("search", [(0, 0), (3, 0), (0, 2), (2, 1)], ids=str)
def test_the_search_stays_within_its_range(search, kernels):
    """A head out of reach is approached as far as the search goes."""
    far = (ELLIPSE[0] + 6, ELLIPSE[1] + 5, *ELLIPSE[2:])
    match, _ = search_local(kernels, scene(far), ELLIPSE, ALL_SKIN, 1, search, P)
    assert match.ellipse == (ELLIPSE[0] + search[0], ELLIPSE[1] + search[1], *ELLIPSE[2:])


def test_depth_decides_between_equal_colors(kernels):
    """Of two heads of one color the one at the expected depth is taken; by color alone it may be either."""
    one, other = (22.0, 24.0, 6.0, 8.0), (38.0, 24.0, 6.0, 8.0)
    pair = inside(one, (48, 60)) | inside(other, (48, 60))
    bins = np.where(pair, SKIN, WALL).astype(np.uint16)
    for chosen in (one, other):
        region = SearchRegion(0, 0, bins, inside(chosen, bins.shape).astype(np.uint8))
        match, _ = search_local(kernels, region, ELLIPSE, ALL_SKIN, 1, P.search, P)
        assert match.ellipse == chosen


def test_a_surround_of_the_same_color_counts_against(kernels):
    """The ring's weight keeps the ellipse on a patch of its own size: on one color everywhere the score is
    1 - w + v (1 - r).
    """
    region = SearchRegion(0, 0, np.zeros((48, 60), np.uint16), np.ones((48, 60), np.uint8))
    match, _ = search_local(kernels, region, ELLIPSE, ALL_SKIN, 1, (0, 0), P)
    expected = 1 - P.ring_weight + P.depth_weight * (1 - P.depth_ring)
    assert match.score == pytest.approx(expected, abs=1e-12)


def test_outside_the_picture_is_nothing(kernels):
    """Where no cell has a bin, score and intersection are 0, not NaN, and the histogram is empty."""
    region = SearchRegion(0, 0, np.full((48, 60), 65535, np.uint16), np.zeros((48, 60), np.uint8))
    match, _ = search_local(kernels, region, ELLIPSE, ALL_SKIN, 1, P.search, P)
    assert match[1:] == (0, 0, 0)
    assert not colors_of(kernels, region, ELLIPSE).any()


def test_only_the_heads_depth_is_learned(kernels):
    """Of an ellipse half on the wall only the cells at the head's depth count; with learn="all" as
    many of each as there are.
    """
    half = (ELLIPSE[0] + 4, *ELLIPSE[1:])
    region = scene()
    np.testing.assert_array_equal(colors_of(kernels, region, half), model(1, 0, 0))
    seen = inside(half, region.bins.shape)
    skin = np.count_nonzero(seen & (region.bins == SKIN)) / seen.sum()
    everything = colors_of(kernels, region, half, Params(bins=P.bins, learn="all"))
    np.testing.assert_allclose(everything, model(skin, 0, 1 - skin), rtol=0, atol=1e-15)


@pytest.mark.parametrize("coherent", [0, MIN_COHERENT_CELLS - 1, MIN_COHERENT_CELLS])
def test_too_few_cells_at_the_depth_are_not_used(coherent, kernels):
    """With fewer than MIN_COHERENT_CELLS at the head's depth, all of the ellipse count, else these alone."""
    region = scene()
    skin = np.argwhere(region.bins == SKIN)[:coherent]
    region.coherent[:] = 0
    region.coherent[tuple(skin.T)] = 1
    wide = (*ELLIPSE[:2], 9.0, 12.0)
    learned = colors_of(kernels, region, wide)
    assert learned.sum() == pytest.approx(1)
    assert (learned[WALL] == 0) == (coherent >= MIN_COHERENT_CELLS)


@pytest.mark.parametrize("hair", [0.0, 0.5, 1.0])
def test_the_first_model_contains_hair(hair, kernels):
    """The first model is the ellipse's histogram and its cap's, mixed by ``hair``, of sum 1. Its share of
    hair is mixed from that of the whole ellipse and that of its top.
    """
    region = scene()
    top = np.indices(region.bins.shape)[0] < 24 - 4  # the cap ends at 24 - 0.4 x 8
    region.bins[top & (region.bins == SKIN)] = HAIR
    found = measure_first_histogram(kernels, region, ELLIPSE, 1, Params(bins=P.bins, hair=hair))
    assert found.shape == (SIZE,)
    assert found.sum() == pytest.approx(1, abs=1e-12)
    head = inside(ELLIPSE, region.bins.shape)
    whole = np.count_nonzero(region.bins[head] == HAIR) / head.sum()
    cap = inside((30.0, 24.0 - 0.7 * 8, 6.0, 0.3 * 8), region.bins.shape) & head
    on_top = np.count_nonzero(region.bins[cap] == HAIR) / cap.sum()
    assert found[HAIR] == pytest.approx((1 - hair) * whole + hair * on_top, abs=1e-12)
