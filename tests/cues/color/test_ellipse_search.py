# SPDX-License-Identifier: MIT
"""The search of a head by the intersection of histograms."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels
from tricue.reference.cues.color.detail.ellipse_counts import count, masks_of

Bins = NDArray[np.uint16]
Floats = NDArray[np.float64]
Grid = tuple[int, int, int]
SIZE = 12
NO_BIN = 65535


def case(seed: int, **changes: Any) -> dict[str, Any]:
    """Arguments: an ellipse in, over the edge of or beside a small picture with pixels without a bin."""
    rng = np.random.default_rng(seed)
    shape = (int(rng.integers(1, 40)), int(rng.integers(1, 60)))
    coarse = rng.integers(0, SIZE, (14, 20)).repeat(3, axis=0).repeat(3, axis=1)[: shape[0], : shape[1]]
    coarse = np.where(rng.random(shape) < 0.3, rng.integers(0, SIZE, shape), coarse)
    bins = np.where(rng.random(shape) < 0.05, NO_BIN, coarse).astype(np.uint16)
    place = np.append(rng.uniform(-15, 55, 2), rng.uniform(0.2, 15, 2))
    return {
        "bins": bins,
        "ellipse": np.ceil(place * 64) / 64,  # so that no place of the grid is rounded
        "grid": (int(rng.integers(1, 6)), int(rng.integers(1, 8)), int(rng.integers(1, 4))),
        "model": rng.random(SIZE) * (rng.random(SIZE) < 0.7) + 1e-3 * np.eye(SIZE)[0],
        "margin": float(rng.uniform(1, 2)),
        "mask": rng.integers(0, 3, shape).astype(np.uint8),
    } | changes


def tolerance(arguments: dict[str, Any]) -> float:
    """Half a unit for each of at most n pixels, over n: less than the larger ellipse's area / 2^31."""
    minor, major = arguments["ellipse"][2:] * arguments["margin"]
    return float((2 * minor + 2) * (2 * major + 2) / 2**31)


def places(ellipse: Floats, grid: Grid) -> Floats:
    """The ellipses (rows cols, 4) of a grid, as the contract has it."""
    rows, cols, step = grid
    return np.array(
        [
            ellipse + [(j - cols // 2) * step, (i - rows // 2) * step, 0, 0]
            for i in range(rows)
            for j in range(cols)
        ]
    )


def full_counts(arguments: dict[str, Any]) -> list[NDArray[np.int64]]:
    """Histograms of ellipses and of rings at every place, each counted from scratch in the twin's pixels."""
    bins, margin = arguments["bins"], arguments["margin"]
    masks = [masks_of(each, margin, bins.shape) for each in places(arguments["ellipse"], arguments["grid"])]
    return [np.array([count(bins, pixels, SIZE) for pixels in each]) for each in zip(*masks, strict=True)]


@given(st.integers(0, 2**32))
def test_twin_finds_the_same(seed: int) -> None:
    """Native and reference agree: shares of the mask to the last bit, intersections within its rounding."""
    arguments = case(seed)
    native, twin = _core.ellipse_search(**arguments), reference.ellipse_search(**arguments)
    assert native.dtype == np.float64
    assert native.shape == twin.shape == (*arguments["grid"][:2], 4)
    assert_array_equal(native[..., 2:], twin[..., 2:])
    assert_allclose(native[..., :2], twin[..., :2], rtol=0, atol=tolerance(arguments))


@given(st.integers(0, 2**32))
def test_counts_are_those_of_full_histograms(seed: int) -> None:
    """A model of a single bin makes (1) that bin's count over n, with nothing to round: bin by bin, at every
    place, the counts kept along the walk are exactly those that are counted from scratch.
    """
    arguments = case(seed)
    for k, counts in enumerate(full_counts(arguments)):
        pixels = counts.sum(axis=1, keepdims=True)
        expected = counts / np.maximum(pixels, 1)
        for one in range(SIZE):
            for kernels in (_core, reference):
                found = kernels.ellipse_search(**arguments | {"model": np.eye(SIZE)[one]})
                assert_array_equal(found[..., k].ravel(), expected[:, one])


@pytest.mark.parametrize("seed", range(20))
def test_agrees_with_the_equation_of_an_ellipse(kernels: Kernels, seed: int) -> None:
    """Inside are the pixels of (x - x0)² / a² + (y - y0)² / b² <= 1, around those up to margin²."""
    arguments = case(seed)
    bins, margin = arguments["bins"], arguments["margin"]
    found = kernels.ellipse_search(**arguments | {"model": np.eye(SIZE)[0]}).reshape(-1, 4)
    y, x = np.mgrid[: bins.shape[0], : bins.shape[1]] + 0.5
    for (x0, y0, minor, major), shares in zip(
        places(arguments["ellipse"], arguments["grid"]), found, strict=True
    ):
        distance = ((x - x0) / minor) ** 2 + ((y - y0) / major) ** 2
        for k, pixels in enumerate((distance <= 1, (distance > 1) & (distance <= margin**2))):
            counted = pixels & (bins != NO_BIN)
            n = max(np.count_nonzero(counted), 1)
            assert shares[k] == np.count_nonzero(counted & (bins == 0)) / n
            assert shares[2 + k] == np.count_nonzero(counted & (arguments["mask"] != 0)) / n


@pytest.mark.parametrize("seed", range(30))
def test_agrees_with_equation_1(kernels: Kernels, seed: int) -> None:
    """From full histograms, (1) in one line of NumPy gives the same, for the ellipse and for the ring."""
    arguments = case(seed)
    model = arguments["model"] / arguments["model"].sum()
    found = kernels.ellipse_search(**arguments)
    for k, counts in enumerate(full_counts(arguments)):
        n = counts.sum(axis=1, keepdims=True)
        expected = np.minimum(counts, n * model).sum(axis=1) / np.maximum(n[:, 0], 1)
        assert_allclose(found[..., k].ravel(), expected, rtol=0, atol=tolerance(arguments))


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """OpenCV's calcHist and compareHist, the latter of sums 1, find the same at the place of the ellipse."""
    bins = np.random.default_rng(0).integers(0, SIZE, (50, 50)).astype(np.uint16)
    model = np.arange(1.0, SIZE + 1)
    found = kernels.ellipse_search(bins, np.array([25.2, 24.7, 12, 15.1]), (1, 1, 1), model, 1.3, None)
    y, x = np.mgrid[:50, :50] + 0.5
    distance = np.hypot((x - 25.2) / 12, (y - 24.7) / 15.1)
    for mask, intersection in zip(
        (distance <= 1, (distance > 1) & (distance <= 1.3)), found[0, 0], strict=False
    ):
        histogram = cv2.calcHist([bins], [0], mask.astype(np.uint8), [SIZE], [0, SIZE]).ravel()
        share, target = histogram / histogram.sum(), (model / model.sum()).astype(np.float32)
        assert abs(intersection - cv2.compareHist(share, target, cv2.HISTCMP_INTERSECT)) < 1e-5


@given(st.integers(0, 2**32))
def test_each_place_is_found_alone(seed: int) -> None:
    """A grid of one place, put where the walk comes to, gives to the last bit what the walk brings there."""
    arguments = case(seed)
    rows, cols, _ = arguments["grid"]
    found = _core.ellipse_search(**arguments).reshape(rows * cols, 4)
    for expected, place in zip(found, places(arguments["ellipse"], arguments["grid"]), strict=True):
        alone = _core.ellipse_search(**arguments | {"ellipse": place, "grid": (1, 1, 1)})
        assert_array_equal(alone[0, 0], expected)


@given(st.integers(0, 2**32), st.integers(2, 5))
def test_steps_are_a_choice_of_places(seed: int, step: int) -> None:
    """Every step-th place of a dense grid is the grid of that step, to the last bit."""
    dense = _core.ellipse_search(**case(seed, grid=(4 * step + 1, 6 * step + 1, 1)))
    sparse = _core.ellipse_search(**case(seed, grid=(5, 7, step)))
    offset = np.array([(4 * step + 1) // 2 - 2 * step, (6 * step + 1) // 2 - 3 * step])
    assert_array_equal(offset, 0)
    assert_array_equal(dense[::step, ::step], sparse)


def test_finds_what_it_learned(kernels: Kernels) -> None:
    """An ellipse of its own colors is found where it is, with an intersection of 1 and none around."""
    rng = np.random.default_rng(5)
    bins = rng.integers(6, SIZE, (60, 80)).astype(np.uint16)
    truth = np.array([43.0, 27.5, 11, 14])
    y, x = np.mgrid[:60, :80] + 0.5
    head = np.hypot((x - truth[0]) / truth[2], (y - truth[1]) / truth[3]) <= 1
    bins[head] = rng.integers(0, 6, np.count_nonzero(head))
    model = np.bincount(bins[head], minlength=SIZE).astype(np.float64)
    found = kernels.ellipse_search(bins, truth + [-5, 2, 0, 0], (9, 16, 1), model, 1.4, head.astype(np.uint8))
    best = np.unravel_index(np.argmax(found[..., 0] - found[..., 1] / 2), (9, 16))
    assert best == (2, 13)
    assert_array_equal(found[best], [1, 0, 1, 0])


def test_head_cut_by_the_edge(kernels: Kernels) -> None:
    """Half outside the picture, an ellipse of the model's colors has its intersection of 1 all the same."""
    bins = np.full((40, 60), 1, np.uint16)
    y, x = np.mgrid[:40, :60] + 0.5
    bins[np.hypot((x - 1.5) / 10, (y - 20.5) / 12) <= 1] = 0
    found = kernels.ellipse_search(bins, np.array([1.5, 20.5, 10, 12]), (5, 9, 1), np.eye(2)[0], 1.4, None)
    assert np.argmax(found[..., 0] - found[..., 1] / 2) == 2 * 9 + 4
    assert_array_equal(found[2, 4], [1, 0, 0, 0])


@given(st.integers(0, 2**32))
def test_shares(seed: int) -> None:
    """All are in [0, 1]; a full mask marks all there is, none nothing; only the model's proportions count."""
    arguments = case(seed)
    found = _core.ellipse_search(**arguments)
    assert found.min() >= 0
    assert found[..., 2:].max() <= 1
    assert found[..., :2].max() <= 1 + tolerance(arguments)
    bare = _core.ellipse_search(**arguments | {"mask": None})
    assert_array_equal(bare[..., :2], found[..., :2])
    assert not bare[..., 2:].any()
    full = _core.ellipse_search(**arguments | {"mask": np.full_like(arguments["mask"], 255)})
    pixels = [counts.sum(axis=1) > 0 for counts in full_counts(arguments)]
    assert_array_equal(full[..., 2:].reshape(-1, 2).T, pixels)
    scaled = _core.ellipse_search(**arguments | {"model": arguments["model"] * 1024})
    assert_array_equal(scaled, found)


def test_nothing_there(kernels: Kernels) -> None:
    """Wholly outside, without a picture or smaller than a pixel's distance: zeros, and no ring gives none."""
    for ellipse in ([1e300, 5.0, 9, 9], [-1e9, -1e9, 9, 9], [30, 2.0**31, 9, 9], [-40.0, 5, 9, 9]):
        assert not kernels.ellipse_search(**case(0, ellipse=np.array(ellipse))).any()
    empty = np.empty((0, 5))
    nothing = {"bins": empty.astype(np.uint16), "mask": empty.astype(np.uint8)}
    assert not kernels.ellipse_search(**case(0, **nothing)).any()
    assert not kernels.ellipse_search(**case(0, ellipse=np.array([5.0, 5, 0.3, 0.3]), margin=1.2)).any()
    assert not kernels.ellipse_search(**case(0, margin=1.0))[..., 1::2].any()


def test_many_bins(kernels: Kernels) -> None:
    """Over more bins than pixels, all of them in the model, it is (1) still."""
    bins = np.random.default_rng(1).permutation(65535)[:3000].astype(np.uint16).reshape(50, 60)
    arguments = case(0, bins=bins, model=np.ones(65535), grid=(2, 3, 1))
    found = kernels.ellipse_search(**arguments | {"ellipse": np.array([30.0, 25, 15, 18]), "mask": None})
    y, x = np.mgrid[:50, :60] + 0.5
    n = np.count_nonzero(np.hypot((x - 30) / 15, (y - 25) / 18) <= 1)
    assert_allclose(found[..., 0], n / 65535, rtol=0, atol=2 * 15 * 2 * 18 * arguments["margin"] ** 2 / 2**31)


@pytest.mark.parametrize("empty", [0, 1, 7, 8, 9])
def test_every_bin_counts_where_all_are_seen(kernels: Kernels, empty: int) -> None:
    """Of 65535 bins, each seen in two pixels, those that the model lacks are the share that doesn't match."""
    bins = np.tile(np.arange(NO_BIN), 2).astype(np.uint16).reshape(255, 514)
    model = np.ones(NO_BIN)
    model[1000 : 1000 + empty] = 0
    found = kernels.ellipse_search(bins, np.array([257.0, 127.5, 600, 600]), (1, 1, 1), model, 1.0, None)
    assert_allclose(found[0, 0], [1 - empty / NO_BIN, 0, 0, 0], rtol=1e-15)


BAD: list[tuple[dict[str, Any], str]] = [
    ({"ellipse": np.zeros(5)}, r"ellipse: expected shape \(4,\), got \(5,\)"),
    ({"ellipse": np.full(4, np.inf)}, "ellipse: expected finite numbers, got inf"),
    ({"ellipse": np.array([1.0, 1, -1, 5])}, "ellipse: expected semi-axes above 0, got -1"),
    (
        {"ellipse": np.array([1.0, 1, 4097, 5]), "margin": 1.0},
        "ellipse: expected semi-axes of at most 4096 px",
    ),
    ({"margin": 17.0}, "margin: expected 1 to 16, got 17"),
    ({"margin": np.nan}, "margin: expected 1 to 16, got nan"),
    ({"grid": (0, 16, 1)}, r"grid: expected rows, cols and a step of 1 to 1024, .* got \(0, 16, 1\)"),
    ({"grid": (4, 1025, 1)}, "grid: expected rows, cols and a step of 1 to 1024"),
    ({"grid": (4, 16, 0)}, "grid: expected rows, cols and a step of 1 to 1024"),
    ({"grid": (4, 129, 128)}, "grid: .* over at most 16384 pixels, got"),
    ({"model": np.empty(0)}, "model: expected at least one bin, got none"),
    ({"model": np.zeros(SIZE)}, "model: expected a finite sum above 0, got 0"),
    ({"model": np.full(SIZE, 1e308)}, "model: expected a finite sum above 0, got inf"),
    ({"model": np.array([1, np.nan] * 6)}, "model: expected finite numbers, got nan"),
    ({"model": np.array([1, -0.5] * 6)}, "model: expected no negative number, got -0.5"),
    ({"model": np.ones(65536)}, "size: expected 1 to 65535 bins, got 65536"),
    ({"model": np.ones(3)}, "bins: expected bins below 3, or 65535 for none, got 11"),
    ({"mask": np.zeros((3, 3), np.uint8)}, r"mask: expected shape \(4, 6\), got \(3, 3\)"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong values and shapes are named."""
    bins = (np.arange(24) % SIZE).astype(np.uint16).reshape(4, 6)
    arguments = case(0, bins=bins, mask=np.zeros((4, 6), np.uint8)) | changes
    with pytest.raises(ValueError, match=message.replace("px", "pixels")):
        kernels.ellipse_search(**arguments)


def test_native_refuses_other_types() -> None:
    """Another type or layout is named, not converted."""
    for name in ("bins", "mask"):
        with pytest.raises(TypeError, match=f"{name}: expected"):
            _core.ellipse_search(**case(0, **{name: np.zeros((3, 3))}))
    with pytest.raises(ValueError, match="bins: expected a C-contiguous"):
        _core.ellipse_search(**case(0, bins=np.zeros((4, 6), np.uint16)[:, ::2]))
