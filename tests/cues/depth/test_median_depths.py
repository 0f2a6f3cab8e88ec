# SPDX-License-Identifier: MIT
"""The depths of targets in boxes: medians of what is near the expected depth."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.stats import median_abs_deviation
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]

BOXES = np.array(
    [
        [30.3, 20.1, 25.0, 31.7],
        [1.0, 1.0, 40.0, 8.0],
        [80.0, 55.0, 9.1, 3.3],
        [5.5, 0.5, 1e-3, 1e-3],
        [40.0, 30.0, 500.0, 300.0],
        [-70.0, 20.0, 30.0, 30.0],
        [1e300, -1e300, 1e305, 1e-305],
    ]
)


@pytest.mark.parametrize("samples", [1, 7, 48])
@pytest.mark.parametrize("expected", [np.nan, 2.6, -1.0])
@pytest.mark.parametrize("max_offset", [0.02, 0.5, 1e30])
def test_native_is_the_twin(picture: Depth, samples: int, expected: float, max_offset: float) -> None:
    """Both have the same bits on any picture and box: a median is one of the numbers, or a mean of two."""
    for share in (0.0, 0.1, 1.0):
        arguments = picture, BOXES, samples, expected, max_offset, share
        native, twin = _core.median_depths(*arguments), reference.median_depths(*arguments)
        assert native.dtype == twin.dtype == np.float64
        assert native.shape == (len(BOXES), 3)
        assert_array_equal(native, twin)


@pytest.mark.parametrize("count", [1, 2, 3, 30, 31])
@pytest.mark.parametrize("ties", [False, True])
def test_is_scipys_median_deviation(kernels: Kernels, count: int, ties: bool) -> None:
    """With a sample for each pixel it is NumPy's median, and SciPy's median deviation as a normal sigma."""
    depth = np.random.default_rng(count).normal(2, 0.05, (count, count)).astype(np.float32)
    depth = np.round(depth, 2) if ties else depth
    box = np.array([[count / 2, count / 2, count, count]])
    ((z, spread, share),) = kernels.median_depths(depth, box, count, np.nan, 10.0, 0.1)
    assert z == np.median(depth)
    assert_allclose(spread, median_abs_deviation(depth, axis=None, scale="normal"), rtol=1e-4)
    assert share == 1


def test_of_no_boxes_there_are_no_depths(kernels: Kernels) -> None:
    """No boxes give (0, 3)."""
    found = kernels.median_depths(np.ones((4, 5), np.float32), np.empty((0, 4)), 8, 2.0, 0.1, 0.1)
    assert found.shape == (0, 3)


def test_reads_the_ellipse_where_a_depth_is_expected(kernels: Kernels) -> None:
    """With an expected depth the corners of a box don't count, and the share is that of its ellipse: of two
    halves at two depths, both of which are near, a half each. Without one the whole square counts.
    """
    y, x = np.mgrid[:48, :48] + 0.5
    ellipse = ((x - 24) / 12) ** 2 + ((y - 24) / 24) ** 2 <= 1
    depth = np.where(ellipse, 2.0, 2.2).astype(np.float32)
    box = np.array([[24.0, 24.0, 24.0, 48.0]])
    assert_allclose(kernels.median_depths(depth, box, 48, 2.1, 0.3, 0.1), [[2, 0, 1]], atol=1e-6)
    ((z, _, share),) = kernels.median_depths(depth, box, 48, np.nan, 0.1, 0.1)
    assert z == pytest.approx(2.2)
    assert share == pytest.approx(1 - ellipse.mean())
    halves = np.where(y < 24, 2.0, 3.0).astype(np.float32)
    ((z, _, share),) = kernels.median_depths(halves, box, 48, 2.9, 0.3, 0.1)
    assert (z, share) == (3.0, 0.5)


def test_what_is_not_measured_counts_only_where_a_depth_is_expected(kernels: Kernels) -> None:
    """The share is of the ellipse's samples, and without an expected depth of those that are measured."""
    depth = np.full((20, 20), 2.0, np.float32)
    depth[:, ::4] = np.nan
    box = np.array([[10.0, 10.0, 20.0, 20.0]])
    assert kernels.median_depths(depth, box, 20, np.nan, 0.5, 0.1)[0, 2] == 1
    assert kernels.median_depths(depth, box, 20, 2.0, 0.5, 0.1)[0, 2] == pytest.approx(0.75, abs=0.02)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 0, -2.0, 0.001, 1000, 1e-40])
def test_what_is_no_depth_is_not_measured(kernels: Kernels, value: float) -> None:
    """What isn't between 1 mm and 1 km gives NaN, whatever is expected."""
    depth, box = np.full((9, 9), value, np.float32), np.array([[4.5, 4.5, 9.0, 9.0]])
    for expected in (np.nan, 0.002, 1000.0):
        assert np.isnan(kernels.median_depths(depth, box, 9, expected, 3.0, 0.0)).all()


@pytest.mark.parametrize("expected", [np.nan, 2.0])
def test_too_small_a_share_is_nothing(kernels: Kernels, expected: float) -> None:
    """A box is measured from min_share of its samples on."""
    depth = np.full((10, 10), 2.0, np.float32)
    depth[:4] = 6.0
    box = np.array([[5.0, 5.0, 10.0, 10.0]])
    share = kernels.median_depths(depth, box, 10, expected, 0.5, 0.0)[0, 2]
    assert 0.5 < share < 0.7
    assert not np.isnan(kernels.median_depths(depth, box, 10, expected, 0.5, share)).any()
    assert np.isnan(kernels.median_depths(depth, box, 10, expected, 0.5, share + 1e-9)).all()


GOOD = {
    "depth": np.full((4, 5), 2.0, np.float32),
    "boxes": np.array([[2.0, 2.0, 3.0, 3.0]]),
    "samples": 8,
    "expected": 2.0,
    "max_offset": 0.1,
    "min_share": 0.2,
}
BAD: list[tuple[dict[str, Any], str]] = [
    ({"boxes": np.ones((2, 3))}, "boxes: expected shape"),
    ({"boxes": np.array([[2.0, np.nan, 3.0, 3.0]])}, "boxes: expected finite numbers, got nan"),
    ({"boxes": np.array([[2.0, 2.0, 3.0, 0.0]])}, "boxes: expected widths and heights above 0, got 0"),
    ({"samples": 0}, "samples: expected 1 to 1024, got 0"),
    ({"samples": 1025}, "samples: expected 1 to 1024, got 1025"),
    ({"expected": np.inf}, "expected: expected a finite number or NaN, got inf"),
    ({"max_offset": 0.0}, "max_offset: expected a finite number above 0, got 0"),
    ({"max_offset": np.inf}, "max_offset: expected a finite number above 0, got inf"),
    ({"min_share": -0.1}, "min_share: expected 0 to 1, got -0.1"),
    ({"min_share": np.nan}, "min_share: expected 0 to 1, got nan"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Numbers out of range are named, with what was expected."""
    with pytest.raises(ValueError, match=message):
        kernels.median_depths(**GOOD | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers are named, never converted."""
    with pytest.raises(TypeError, match="depth: expected a float32 depth image"):
        _core.median_depths(**GOOD | {"depth": np.ones((4, 5))})
    with pytest.raises(TypeError, match="boxes: expected float64"):
        _core.median_depths(**GOOD | {"boxes": np.ones((1, 4), np.float32)})
