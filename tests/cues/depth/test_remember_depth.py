# SPDX-License-Identifier: MIT
"""What was last seen in each pixel beside a target."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]
Region = tuple[int, int, int, int]
NOTHING = np.empty((0, 0), np.float32)
EVERYWHERE = (-(2**31), -(2**31), 2**31 - 1, 2**31 - 1)

places = st.integers(-20, 220)


@given(st.integers(0, 2**32), st.tuples(places, places, places, places), st.floats(-9, 9), st.floats(0, 5))
def test_twin_remembers_the_same(seed: int, region: Region, z: float, reach: float) -> None:
    """Native and reference give the same bits for any images, regions and depths, with something remembered
    and without.
    """
    rng = np.random.default_rng(seed)
    shape = int(rng.integers(0, 40)), int(rng.integers(0, 200))
    depth, before = (rng.uniform(-1, 8, shape).astype(np.float32) for _ in range(2))
    depth[rng.random(shape) < 0.2] = np.nan
    for old in (before, NOTHING):
        native = _core.remember_depth(depth, old, region, z, reach)
        assert_array_equal(native, reference.remember_depth(depth, old, region, z, reach), strict=True)


@pytest.mark.parametrize("region", [EVERYWHERE, (3, 2, 70, 40), (5, 5, 5, 9), (70, 40, 3, 2)])
def test_twin_remembers_pictures_the_same(picture: Depth, region: Region) -> None:
    """They also agree on pictures of awkward sizes and layouts, and on regions beyond them, or empty."""
    native = _core.remember_depth(picture, picture[::-1].copy(), region, 2.5, 1.0)
    twin = reference.remember_depth(picture, picture[::-1].copy(), region, 2.5, 1.0)
    assert_array_equal(native, twin, strict=True)


def test_agrees_with_a_loop(kernels: Kernels, noisy_room: Depth) -> None:
    """Pixel by pixel, in the words of the contract."""
    before = np.full(noisy_room.shape, 7, np.float32)
    x0, y0, x1, y1 = 60, 20, 110, 130
    expected = noisy_room.copy()
    for y in range(y0, y1):
        for x in range(x0, x1):
            if abs(noisy_room[y, x] - np.float32(2.5)) < np.float32(0.5):
                expected[y, x] = 7
    seen = kernels.remember_depth(noisy_room, before, (x0, y0, x1, y1), 2.5, 0.5)
    assert_array_equal(seen, expected)
    assert 100 < np.count_nonzero(seen == 7) < (x1 - x0) * (y1 - y0)


def test_the_target_hides_what_is_unknown(kernels: Kernels) -> None:
    """With nothing remembered the target's pixels become NaN; the image itself stays as it is."""
    depth = np.array([[2, 2.4, 2.6, 2, np.nan]], np.float32)
    given_depth = depth.copy()
    seen = kernels.remember_depth(depth, NOTHING, (0, 0, 3, 1), 2.0, 0.5)
    assert_array_equal(seen, np.array([[np.nan, np.nan, 2.6, 2, np.nan]], np.float32))
    assert_array_equal(depth, given_depth)


def test_remembering_twice_changes_nothing(kernels: Kernels, noisy_room: Depth) -> None:
    """What is remembered of the same frame again is what was remembered of it."""
    region = (60, 20, 110, 130)
    once = kernels.remember_depth(noisy_room, NOTHING, region, 2.5, 0.5)
    assert_array_equal(kernels.remember_depth(noisy_room, once, region, 2.5, 0.5), once)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"z": np.nan}, "z: expected a finite number, got nan"),
        ({"reach": -1.0}, "reach: expected a finite number, not negative, got -1"),
        ({"reach": np.inf}, "reach: expected a finite number, not negative, got inf"),
        ({"before": np.ones((3, 2), np.float32)}, r"before: expected shape \(2, 3\), got \(3, 2\)"),
        ({"before": np.ones((0, 3), np.float32)}, r"before: expected shape \(2, 3\), got \(0, 3\)"),
    ],
)
def test_refuses(kernels: Kernels, values: dict[str, Any], message: str) -> None:
    """Images and depths that are none are named."""
    one = np.ones((2, 3), np.float32)
    given_values: dict[str, Any] = {"before": one, "region": (0, 0, 1, 1), "z": 1.0, "reach": 0.5}
    with pytest.raises(ValueError, match=message):
        kernels.remember_depth(one, **given_values | values)


@pytest.mark.parametrize("place", [0, 1])
def test_native_refuses_other_arrays(place: int) -> None:
    """Another type is named, not converted."""
    images: list[Any] = [np.ones((2, 2), np.float32)] * 2
    images[place] = images[place].astype(float)
    with pytest.raises(
        TypeError, match=r"(depth|before): expected a float32 depth image \(H, W\), got float64"
    ):
        _core.remember_depth(images[0], images[1], (0, 0, 1, 1), 1.0, 0.5)
