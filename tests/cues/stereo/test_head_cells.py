# SPDX-License-Identifier: MIT
"""The cells of a head's search: their color bins, and which are at its depth."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from scipy import ndimage
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]
SPACE = (8, 8, 4), 64
MATCHING = 5, 5, True  # window, uniqueness, prefilter


def case(seed: int) -> dict[str, Any]:
    """Arguments: a pair at one disparity in patches of color, regions in it, over its edges and beside it."""
    rng = np.random.default_rng(seed)
    step = int(rng.integers(1, 5))
    shape = int(rng.integers(step, 60)), int(rng.integers(step, 120))
    left = rng.integers(0, 256, (*shape, 3)).astype(np.uint8)
    right = np.roll(left, -step * int(rng.integers(0, 5)), 1)
    if rng.random() < 0.3:
        right = np.ascontiguousarray(right[..., 1])
    left[: shape[0] // 3] //= 64
    x, y = int(rng.integers(-12, 30)), int(rng.integers(-12, 20))
    first = int(rng.integers(-4, 5))
    prefilter = bool(rng.integers(0, 2))
    return {
        "left": left,
        "right": right,
        "region": (x, y, x + int(rng.integers(1, 40)), y + int(rng.integers(1, 40))),
        "step": step,
        "space": SPACE,
        "gains": tuple(rng.uniform(0, 2, 3).tolist()) if rng.random() < 0.5 else None,
        "depth": (float(rng.integers(-2, 8)), float(rng.choice([0, 0.5, 1])), int(rng.choice([1, 3, 7, 41]))),
        "limits": (first, first + int(rng.integers(0, 12))),
        "matching": (int(rng.choice([1, 3, 5, 9])), int(rng.choice([0, 5, 100])), prefilter),
    }


@given(st.integers(0, 2**32))
def test_twin_gives_the_same(seed: int) -> None:
    """Native and reference agree to the last bit, though the one turns only a part of the images gray: all
    are whole numbers, or float32 in a fixed order.
    """
    arguments = case(seed)
    native, twin = _core.head_cells(**arguments), reference.head_cells(**arguments)
    for one, other in zip(native, twin, strict=True):
        assert one.dtype == other.dtype
        assert_array_equal(one, other)


@given(st.integers(0, 2**32))
def test_agrees_with_the_single_kernels_and_scipy(seed: int) -> None:
    """The bins are those of color_bins. Disparities are those of whole gray images, and where there is none
    SciPy's uniform filter sums the votes.
    """
    arguments = case(seed)
    step, (x0, y0, x1, y1) = arguments["step"], arguments["region"]
    left, right = arguments["left"], arguments["right"]
    bins, coherent = _core.head_cells(**arguments)
    pixels = (step * x0, step * y0, step * x1, step * y1)
    gains = None if arguments["gains"] is None else np.array(arguments["gains"])
    assert_array_equal(bins, _core.color_bins(left, pixels, SPACE, step, gains))

    gray = _core.reduce_gray(left, step), _core.reduce_gray(right, step)
    search = arguments["limits"], arguments["matching"]
    plane = _core.sad_disparity(*gray, arguments["region"], False, *search)
    expected, tolerance, fill = arguments["depth"]
    near = np.abs(plane - np.float32(expected)) <= tolerance
    votes = np.where(np.isnan(plane), 0, np.where(near, 1.0, -1.0))
    sums = np.rint(ndimage.uniform_filter(votes, fill, mode="constant") * fill**2)
    rows, columns = np.mgrid[y0:y1, x0:x1]
    inside = (rows >= 0) & (rows < gray[0].shape[0]) & (columns >= 0) & (columns < gray[0].shape[1])
    assert_array_equal(coherent, np.where(votes == 0, sums > 0, votes > 0) & inside)


def test_gaps_are_filled_by_the_majority(kernels: Kernels) -> None:
    """A patch of one color on what is at the head's depth is the head's; on what is behind it, it isn't."""
    rng = np.random.default_rng(0)
    left = rng.integers(0, 256, (40, 80, 3)).astype(np.uint8)
    left[15:25, 35:45] = 90
    for disparity in (5, 9):
        right = np.roll(left, -disparity, 1)
        _, coherent = kernels.head_cells(
            left, right, (25, 5, 55, 35), 1, SPACE, None, (5.0, 0.6, 31), (1, 10), MATCHING
        )
        assert coherent[8:22, 8:22].all() == (disparity == 5)
        assert coherent[8:22, 8:22].any() == (disparity == 5)


def test_nothing_is_outside_the_image(kernels: Kernels) -> None:
    """Cells beyond the edge have no bin, and aren't at the head's depth, though all beside them are."""
    left = np.random.default_rng(1).integers(0, 256, (24, 60, 3)).astype(np.uint8)
    bins, coherent = kernels.head_cells(
        left, np.roll(left, -4, 1), (-5, -6, 65, 30), 1, SPACE, None, (4.0, 1.0, 41), (0, 8), MATCHING
    )
    inside = np.zeros((36, 70), np.bool_)
    inside[6:30, 5:65] = True
    assert_array_equal(bins != 65535, inside)
    assert not coherent[~inside].any()
    assert coherent[inside].mean() > 0.9


BAD: list[tuple[dict[str, Any], str]] = [
    ({"depth": (np.nan, 1.0, 7)}, "expected: expected a finite number"),
    ({"depth": (5.0, -1.0, 7)}, "tolerance: expected 0 or more"),
    ({"depth": (5.0, np.nan, 7)}, "tolerance: expected 0 or more"),
    ({"depth": (5.0, 1.0, 4)}, "fill: expected an odd number from 1 to 127, got 4"),
    ({"depth": (5.0, 1.0, -1)}, "fill: expected an odd number from 1 to 127"),
    ({"depth": (5.0, 1.0, 129)}, "fill: expected an odd number from 1 to 127"),
    ({"step": 0}, "step: expected 1 to the image's smaller side, got 0"),
    ({"step": 13}, "step: expected 1 to the image's smaller side, got 13"),
    ({"right": np.zeros((12, 15, 3), np.uint8)}, r"right: expected the left image's shape"),
    ({"left": np.zeros((0, 16, 3), np.uint8)}, "left: expected at least one pixel"),
    ({"region": (0, 0, 0, 4)}, "region: expected a width and height"),
    ({"region": (2**30, 0, 2**30 + 4, 4)}, "region: expected corners within a billion pixels"),
    ({"limits": (0, -1)}, "last: expected at least first"),
    ({"matching": (4, 5, True)}, "window: expected an odd number"),
    ({"space": ((8, 0, 4), 64)}, "bins: expected 1 to 256 on each axis"),
    ({"gains": (1.0, -1.0, 1.0)}, "gains: expected finite numbers, none negative"),
]


@pytest.mark.parametrize(("changes", "text"), BAD)
def test_bad_values_are_refused(kernels: Kernels, changes: dict[str, Any], text: str) -> None:
    """Errors name the argument, what was expected and what came."""
    image = np.zeros((12, 16, 3), np.uint8)
    arguments = {"left": image, "right": image, "region": (0, 0, 4, 5), "step": 1, "space": SPACE}
    arguments |= {"gains": None, "depth": (5.0, 1.0, 7), "limits": (0, 4), "matching": MATCHING}
    if "left" in changes:
        changes = changes | {"right": changes["left"]}
    if "region" in changes and changes["region"][0] > 0:
        changes = changes | {"step": 2}
    with pytest.raises(ValueError, match=text):
        kernels.head_cells(**arguments | changes)
