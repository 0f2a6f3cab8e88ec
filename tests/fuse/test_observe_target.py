# SPDX-License-Identifier: MIT
"""What a frame shows of the target: its pixels, and what is in its blocks."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import Place, with_argument

RANGES = [(-4.0, 4.0), (-3.0, 5.0), (0.0, 16.0)]
OURS = (1.5, 0.5, 8.0)
H, W, BINS = 40, 60, 32


def grid(columns: int = 6, rows: int = 4) -> np.ndarray:
    """(N, 4) corners of blocks of 5 x 5 pixels around (0, 0)."""
    i, j = (each.ravel() for each in np.meshgrid(np.arange(columns), np.arange(rows)))
    left, top = 5.0 * i - 2.5 * columns, 5.0 * j - 2.5 * rows
    return np.stack([left, top, left + 5, top + 5], axis=1)


def density(at: float, low: float, high: float) -> np.ndarray:
    """(BINS,) a narrow peak, of sum 1."""
    centers = low + (np.arange(BINS) + 0.5) * (high - low) / BINS
    values = np.exp(-0.5 * ((centers - at) / 0.5) ** 2)
    return values / values.sum()


def case(seed: int = 0, cues: int = 3, **changes: Any) -> dict[str, Any]:
    """A target in the middle before something else, with gaps and noise, in a grid that reaches out of it."""
    rng = np.random.default_rng(seed)
    inside = np.zeros((H, W), np.bool_)
    inside[10:30, 20:40] = True
    planes = []
    for ours, (low, high) in zip(OURS, RANGES[:cues], strict=False):
        plane = np.where(inside, ours, low + 0.2 * (high - low)) + rng.normal(0, 0.3, (H, W))
        plane[rng.random((H, W)) < 0.1] = np.nan
        planes.append(plane.astype(np.float32))
    densities = np.array([density(at, *ends) for at, ends in zip(OURS, RANGES, strict=True)])
    corners = grid()
    return {
        "planes": planes,
        "model": (densities[:cues], RANGES[:cues], np.full((cues, BINS), 1 / BINS)),
        "prior": ((18.0, 8.0, 42.0, 32.0), (10.0, 4.0, 50.0, 38.0)),
        "threshold": 0.5,
        "clean": (3, 0.2, 0.02),
        "disparity": planes[2] if cues > 2 else None,
        "grid": (corners, (1.1, 230.0, 120.0, 200.0, 100.0)),
        "states": rng.integers(0, 3, len(corners)),
        "limits": (8.0, 0.75, 10.0),
        **changes,
    }


@given(st.integers(0, 2**32), st.integers(1, 3), st.floats(0.2, 3), st.floats(-30, 30))
def test_twin_gives_the_same(seed: int, cues: int, size: float, shift: float) -> None:
    """Native and reference agree on any place of the grid: to the last bit, but for means, whose sums of at
    most 2400 float32 in another order differ by 2400 EPS of the largest.
    """
    arguments = case(seed, cues, grid=(grid(), (size, 230.0 + shift, 120.0 - shift, 200.0, 100.0)))
    ours, theirs = (each.observe_target(**arguments) for each in (_core, reference))
    assert ours[:2] == theirs[:2]
    assert_array_equal(ours[2], theirs[2], strict=True)
    for i, (one, other) in enumerate(zip(ours[3], theirs[3], strict=True)):
        atol = 16 * 2400 * np.finfo(float).eps if i == 3 else 0
        np.testing.assert_allclose(one, other, rtol=0, atol=atol)
        assert one.dtype == other.dtype
    assert ours[4] == theirs[4]


def test_is_the_kernels_one_by_one(kernels: Kernels) -> None:
    """The pixels are those of target_pixels and temporal_window, the counts those of block_counts."""
    a = case()
    densities, _, alternatives = a["model"]
    box, count, mask, seen, _ = kernels.observe_target(**a)
    found, _ = kernels.target_pixels(
        a["planes"], list(densities), RANGES, *a["prior"], 0.5, list(alternatives)
    )
    assert count > 200
    for one, other in zip((box, count, mask), kernels.temporal_window(found, *a["clean"]), strict=True):
        assert_array_equal(one, other)
    corners, (size, x, y, left, top) = a["grid"]
    blocks = corners * size + [x, y, x, y] - np.array([left, top, left, top])
    counts = kernels.block_counts(mask, a["disparity"], blocks, *a["limits"][:2])
    for one, other in zip(seen, counts, strict=True):
        assert_array_equal(one, other)


def test_finds_what_was_drawn(kernels: Kernels) -> None:
    """Nearly all of the target and hardly anything else is found; its blocks have its disparity."""
    _, count, mask, (cells, targets, measured, mean, similar), share = kernels.observe_target(**case())
    assert mask[10:30, 20:40].mean() > 0.6
    assert mask.sum() - mask[10:30, 20:40].sum() < 10
    assert count == mask.sum()
    x0, y0, x1, y1 = (1.1 * grid() + [30, 20, 30, 20]).T
    middle = (x0 > 20) & (x1 < 40) & (y0 > 10) & (y1 < 30)
    assert middle.sum() == 4
    assert (targets[middle] > 0.5 * cells[middle]).all()
    assert mean[middle] == pytest.approx(8, abs=0.2)
    assert (similar[middle] > 0.8 * measured[middle]).all()
    assert share == 0


def test_occluded_is_what_is_behind_something_nearer(kernels: Kernels) -> None:
    """The share is of the target's blocks in the image; nearer needs a mean above the limit, and a fifth of
    the block measured. Without disparities nothing is occluded, and every cell counts as measured.
    """
    a = case(states=np.ones(24, np.int64))
    nearer = a["disparity"].copy()
    nearer[:, 30:] = 14
    assert kernels.observe_target(**{**a, "disparity": nearer})[4] == 0.5
    states = np.where(grid()[:, 0] >= 0, 1, 0)
    assert kernels.observe_target(**{**a, "disparity": nearer, "states": states})[4] == 1
    assert kernels.observe_target(**{**a, "disparity": nearer, "limits": (8.0, 0.75, 15.0)})[4] == 0
    nearer[(np.arange(H * W) % 8 != 0).reshape(H, W)] = np.nan
    assert kernels.observe_target(**{**a, "disparity": nearer})[4] == 0
    *_, (cells, _, measured, mean, similar), share = kernels.observe_target(**{**a, "disparity": None})
    assert_array_equal(measured, cells)
    assert np.isnan(mean).all()
    assert (share, similar.sum()) == (0, 0)


def test_blocks_outside_the_image_are_empty(kernels: Kernels) -> None:
    """A grid that isn't in the image has no cells, and no share of it is occluded."""
    *_, (cells, targets, _, mean, _), share = kernels.observe_target(
        **case(grid=(grid(), (1.0, -500.0, 0.0, 0.0, 0.0)))
    )
    assert (cells.sum(), targets.sum(), share) == (0, 0, 0)
    assert np.isnan(mean).all()


PLANES, MODEL, PRIOR, THRESHOLD, CLEAN, DISPARITY, GRID, STATES, LIMITS = range(9)
BAD: list[tuple[Place, Any, str]] = [
    (STATES, np.zeros(3, np.int64), "states: expected 24 numbers, got 3"),
    ((GRID, 1), (np.nan, 0.0, 0.0, 0.0, 0.0), "corners: expected finite numbers"),
    ((GRID, 1), (1.0, np.inf, 0.0, 0.0, 0.0), "corners: expected finite numbers"),
    ((GRID, 0), np.zeros((24, 3)), "corners: expected"),
    ((MODEL, 0), np.zeros((2, BINS)), "densities: expected"),
    ((MODEL, 2), np.full((3, BINS + 1), 1 / BINS), "alternatives: expected"),
    ((MODEL, 1), RANGES[:2], "ranges: expected as many as planes, got 2"),
    (DISPARITY, np.zeros((H, W + 1), np.float32), rf"disparity: expected shape \({H}, {W}\)"),
    (THRESHOLD, 0.0, "threshold: expected"),
    ((CLEAN, 0), 9, "neighbors: expected 0 to 8"),
    ((PRIOR, 0), (0.0, 0.0, np.nan, 1.0), "window: expected finite corners"),
    ((PRIOR, 1), (0.0, 0.0, np.inf, 1.0), "candidate: expected finite corners"),
]


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Unlike sizes, and what its parts refuse, are named."""
    with pytest.raises(ValueError, match=message):
        kernels.observe_target(*with_argument(list(case().values()), place, value))


@pytest.mark.parametrize(
    ("place", "value", "error", "message"),
    [
        ((MODEL, 1), np.zeros((3, 2)), TypeError, "model: expected a list or tuple in it, got numpy.ndarray"),
        ((MODEL, 1), [(0.0, 1.0), [0.0, 1.0]], TypeError, "model: expected a tuple in it, got list"),
        ((MODEL, 1), [(0.0, 1.0, 2.0)], ValueError, "ranges: expected a tuple of 2, got one of 3"),
        ((MODEL, 1), [(0.0, "1")], TypeError, "ranges: expected a number in it, got str"),
    ],
)
def test_native_says_what_is_wrong_in_a_list(
    place: Place, value: Any, error: type[Exception], message: str
) -> None:
    """Ranges that aren't a list of pairs of numbers are named."""
    with pytest.raises(error, match=message):
        _core.observe_target(*with_argument(list(case().values()), place, value))


def test_native_refuses_other_types() -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match=r"states: expected int64 \(N,\), got float64"):
        _core.observe_target(**case(states=np.zeros(24)))
