# SPDX-License-Identifier: MIT
"""The depth histogram of a rectangle."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import grid

Floats = NDArray[np.float64]


def case(seed: int, **changes: Any) -> dict[str, Any]:
    """Arguments: a rectangle over the edge of a picture with gaps."""
    rng = np.random.default_rng(seed)
    depth = rng.uniform(0.5, 6, (rng.integers(1, 40), rng.integers(1, 60))).astype(np.float32)
    depth[rng.random(depth.shape) < 0.2] = rng.choice([np.nan, 0, -1, np.inf])
    return {
        "depth": depth,
        "rectangle": np.append(rng.uniform(-10, 40, 4), rng.uniform(1, 5)),
        "levels": int(rng.integers(1, 100)),
        "pattern": rng.uniform(-1, 1, (rng.integers(1, 200), 2)),
        "reach": float(rng.uniform(0.1, 3)),
    } | changes


@given(st.integers(0, 2**32))
def test_twin_counts_the_same(seed: int) -> None:
    """Native and reference agree to the last bit: whole counts and one division."""
    assert_array_equal(_core.rectangle_histogram(**case(seed)), reference.rectangle_histogram(**case(seed)))


def test_strided_rows(kernels: Kernels) -> None:
    """Padded rows and every second row are read as they look."""
    depth = np.random.default_rng(0).uniform(2, 4, (60, 90)).astype(np.float32)
    for view in (depth[5:50, 7:70], depth[::2]):
        expected = kernels.rectangle_histogram(**case(1, depth=view.copy()))
        assert_array_equal(kernels.rectangle_histogram(**case(1, depth=view)), expected)


def test_agrees_with_numpy(kernels: Kernels) -> None:
    """Over whole pixels of a rectangle it is NumPy's histogram of depth less z."""
    depth = np.random.default_rng(3).uniform(2.2, 3.9, (40, 50)).astype(np.float32)
    rectangle = np.array([20.0, 15.0, 20.0, 10.0, 3.0])
    histogram = kernels.rectangle_histogram(depth, rectangle, 16, grid(10, 20), 1.0)
    counts, _ = np.histogram(depth[10:20, 10:30].astype(float) - 3.0, 16, (-1, 1))
    assert_array_equal(histogram, counts / 200)


@given(st.integers(0, 2**32))
def test_a_sum_of_one_or_nothing(seed: int) -> None:
    """The sum is 1, or 0 where the rectangle shows nothing within reach."""
    for kernels in (_core, reference):
        total = kernels.rectangle_histogram(**case(seed)).sum()
        assert total == 0 or abs(total - 1) < 1e-12
    assert not _core.rectangle_histogram(**case(seed, rectangle=np.array([-500.0, 0, 9, 9, 2]))).any()


def test_learns_what_it_is_compared_with(kernels: Kernels) -> None:
    """A rectangle has distance 0 to its own histogram."""
    arguments = case(4, depth=np.full((30, 30), 2.5, np.float32), rectangle=np.array([15.0, 15, 9, 9, 2.4]))
    depth, rectangle, _, pattern, reach = arguments.values()
    model = kernels.rectangle_histogram(**arguments)
    assert kernels.depth_distance(depth, rectangle[None], (model, reach), pattern, 0.3)[0, 0] == 0


BAD: list[tuple[dict[str, Any], str]] = [
    ({"rectangle": np.zeros(4)}, r"rectangle: expected shape \(5,\), got \(4,\)"),
    ({"rectangle": np.full(5, np.nan)}, "rectangle: expected finite numbers, got nan"),
    ({"levels": 0}, "levels: expected 1 to 65536, got 0"),
    ({"levels": 65537}, "levels: expected 1 to 65536, got 65537"),
    ({"pattern": np.zeros((0, 2))}, "pattern: expected at least one place, got none"),
    ({"pattern": np.full((3, 2), np.inf)}, "pattern: expected finite numbers, got inf"),
    ({"reach": 0.0}, "reach: expected a finite number above 0, got 0"),
    ({"reach": np.nan}, "reach: expected a finite number above 0, got nan"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong values and shapes are named."""
    with pytest.raises(ValueError, match=message):
        kernels.rectangle_histogram(**case(0, **changes))


def test_native_refuses_other_types() -> None:
    """Millimeters as integers are named, not converted."""
    with pytest.raises(TypeError, match="depth: expected"):
        _core.rectangle_histogram(**case(0, depth=np.ones((3, 3), np.uint16)))
