# SPDX-License-Identifier: MIT
"""The place of an ellipse that is most like a model, and the colors there."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels
from tricue.reference.base.ellipse_shape import mask_of
from tricue.reference.cues.color.detail.ellipse_counts import count

SIZE = 12
NO_BIN = 65535
SEARCH = ("bins", "ellipse", "grid", "model", "margin", "mask")


def case(seed: int) -> dict[str, Any]:
    """Arguments: an ellipse in, over the edge of or beside a small picture with pixels without a bin."""
    rng = np.random.default_rng(seed)
    shape = (int(rng.integers(1, 40)), int(rng.integers(1, 60)))
    bins = np.where(rng.random(shape) < 0.05, NO_BIN, rng.integers(0, SIZE, shape)).astype(np.uint16)
    place = np.append(rng.uniform(-15, 55, 2), rng.uniform(0.2, 15, 2))
    return {
        "bins": bins,
        "ellipse": np.ceil(place * 64) / 64,  # so that no place of the grid is rounded
        "grid": (int(rng.integers(1, 6)), int(rng.integers(1, 8)), int(rng.integers(1, 4))),
        "model": rng.random(SIZE) * (rng.random(SIZE) < 0.7) + 1e-3 * np.eye(SIZE)[0],
        "margin": float(rng.uniform(1, 2)),
        "mask": rng.integers(0, 3, shape).astype(np.uint8),
        "weights": tuple(rng.uniform(0, 1, 3).tolist()),
        "min_marked": int(rng.choice([0, 1, 8, 200])),
    }


def scores_of(found: NDArray[np.float64], weights: tuple[float, float, float]) -> NDArray[np.float64]:
    """(rows, cols): the scores of what ellipse_search measures."""
    ring, depth, depth_ring = weights
    inside, around, marked, behind = np.moveaxis(found, -1, 0)
    return np.asarray(inside - ring * around + depth * (marked - depth_ring * behind))


@given(st.integers(0, 2**32))
def test_twin_finds_the_same(seed: int) -> None:
    """Native and reference agree on the best place, wherever others are worse by more than the search rounds
    (1), 2^-19 a score of two of them; score, intersection and share within that, colors to the last bit.
    """
    arguments = case(seed)
    native, twin = _core.best_ellipse(**arguments), reference.best_ellipse(**arguments)
    assert native[2:5] == pytest.approx(twin[2:5], rel=0, abs=2**-18) or native[:2] != twin[:2]
    if native[:2] != twin[:2]:  # as good
        assert native[2] == pytest.approx(twin[2], rel=0, abs=2**-18)
        return
    assert_array_equal(native[5], twin[5])


@given(st.integers(0, 2**32))
def test_it_is_the_best_of_the_search(seed: int) -> None:
    """The best has the greatest score of what ellipse_search measures, to the last bit, and of equal ones it
    is the first.
    """
    arguments = case(seed)
    measured = _core.ellipse_search(*(arguments[name] for name in SEARCH))
    scores = scores_of(measured, arguments["weights"])
    row, col, score, intersection, marked, _ = _core.best_ellipse(**arguments)
    assert row * scores.shape[1] + col == scores.argmax()
    assert score == scores.max()
    assert (intersection, marked) == tuple(measured[row, col, [0, 2]])


@given(st.integers(0, 2**32))
def test_colors_are_those_of_a_full_histogram(seed: int) -> None:
    """The colors are those of the twin's pixels at that place, counted: of marked pixels where there are
    enough, else of all.
    """
    arguments = case(seed)
    row, col, *_, colors = _core.best_ellipse(**arguments)
    rows, cols, step = arguments["grid"]
    place = arguments["ellipse"] + [(col - cols // 2) * step, (row - rows // 2) * step, 0, 0]
    inside = mask_of(place, arguments["bins"].shape)
    marked, whole = (
        count(arguments["bins"], pixels, SIZE) for pixels in (inside & (arguments["mask"] != 0), inside)
    )
    enough = arguments["min_marked"] > 0 and marked.sum() >= arguments["min_marked"]
    counts = marked if enough else whole
    assert_array_equal(colors, counts / max(counts.sum(), 1))


def test_pixels_by_hand(kernels: Kernels) -> None:
    """A pixel's own circle has that pixel and its four neighbors, at a distance of exactly 1."""
    bins, nothing = np.arange(25, dtype=np.uint16).reshape(5, 5), np.zeros((5, 5), np.uint8)
    *_, colors = kernels.best_ellipse(
        bins, np.array([2.5, 2.5, 1, 1]), (1, 1, 1), np.ones(25), 1.5, nothing, (0.0, 0.0, 0.0), 0
    )
    assert_array_equal(np.flatnonzero(colors), [7, 11, 12, 13, 17])


def test_a_head_is_found_where_it_is(kernels: Kernels) -> None:
    """A head of one color before a wall of another is found to the pixel, wholly, with its colors alone."""
    y, x = np.mgrid[:48, :60] + 0.5
    head = ((x - 35) / 6) ** 2 + ((y - 21) / 8) ** 2 < 1
    model = np.array([1.0, 0, 0])
    found = kernels.best_ellipse(
        np.where(head, 0, 2).astype(np.uint16), np.array([30.0, 24.0, 6.0, 8.0]), (9, 17, 1), model, 1.5,
        head.astype(np.uint8), (0.6, 0.4, 0.5), 8,
    )  # fmt: skip
    assert found[:2] == (4 - 3, 8 + 5)
    assert found[2:5] == (pytest.approx(1.4), 1.0, 1.0)
    assert_array_equal(found[5], model)


def test_of_equal_places_the_first_counts(kernels: Kernels) -> None:
    """On one color everywhere the first place is the best; without any pixel colors are 0."""
    bins = np.zeros((40, 40), np.uint16)
    arguments = (np.array([20.0, 20, 4, 5]), (3, 5, 1), np.ones(3), 1.5)
    found = kernels.best_ellipse(bins, *arguments, np.ones((40, 40), np.uint8), (0.5, 0.5, 0.5), 1)
    assert found[:2] == (0, 0)
    assert_array_equal(found[5], [1, 0, 0])
    nothing = kernels.best_ellipse(
        np.full_like(bins, NO_BIN), *arguments, np.ones((40, 40), np.uint8), (0.5, 0.5, 0.5), 1
    )
    assert nothing[2:5] == (0, 0, 0)
    assert not nothing[5].any()


BAD: list[tuple[dict[str, Any], str]] = [
    ({"weights": (0.5, np.nan, 0.5)}, "weights: expected finite numbers, got nan"),
    ({"min_marked": -1}, "min_marked: expected 0 or more, got -1"),
    ({"ellipse": np.ones(3)}, r"ellipse: expected shape \(4,\)"),
    ({"ellipse": np.array([1.0, 1, 0, 1])}, "ellipse: expected semi-axes above 0"),
    ({"grid": (0, 1, 1)}, "grid: expected rows, cols and a step of 1 to 1024"),
    ({"model": np.zeros(3)}, "model: expected a finite sum above 0"),
    ({"margin": 0.5}, "margin: expected 1 to 16"),
    ({"bins": np.full((6, 7), 3, np.uint16)}, "bins: expected bins below 3, or 65535 for none, got 3"),
    ({"mask": np.zeros((6, 8), np.uint8)}, r"mask: expected shape \(6, 7\), got \(6, 8\)"),
]


@pytest.mark.parametrize(("changes", "text"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], text: str) -> None:
    """Wrong values and shapes are named."""
    arguments = {
        "bins": np.zeros((6, 7), np.uint16),
        "ellipse": np.array([3.0, 3, 2, 2]),
        "grid": (1, 1, 1),
        "model": np.ones(3),
        "margin": 1.5,
        "mask": np.zeros((6, 7), np.uint8),
        "weights": (0.5, 0.5, 0.5),
        "min_marked": 0,
    }
    with pytest.raises(ValueError, match=text):
        kernels.best_ellipse(**arguments | changes)
