# SPDX-License-Identifier: MIT
"""Where a depth image differs from one before."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]
NOISE, SLOPE = 0.02, 0.005

shapes = st.tuples(st.integers(0, 3), st.integers(0, 150))
amounts = st.floats(0, 1e30)


@given(shapes.flatmap(lambda s: st.tuples(arrays(np.float32, s), arrays(np.float32, s))), amounts, amounts)
def test_twin_compares_the_same(images: tuple[Depth, Depth], noise: float, slope: float) -> None:
    """Native and reference give the same bits for any two images and any noise."""
    native = _core.changed_depth(*images, noise, slope)
    assert_array_equal(native, reference.changed_depth(*images, noise, slope), strict=True)


def test_twin_compares_pictures_the_same(picture: Depth) -> None:
    """They also agree on pictures of awkward sizes and layouts, and next to the limit."""
    with np.errstate(over="ignore"):
        limit = np.float32(NOISE) + np.float32(SLOPE) * picture * picture
    limit[~np.isfinite(limit)] = 1
    for other in (picture + limit, picture - limit, picture + np.nextafter(limit, np.float32(9))):
        native = _core.changed_depth(picture, other, NOISE, SLOPE)
        assert_array_equal(native, reference.changed_depth(picture, other, NOISE, SLOPE), strict=True)


def test_agrees_with_numpy(kernels: Kernels, noisy_room: Depth) -> None:
    """numpy.isclose, of depths that are no rounding off the limit, finds the same pixels."""
    before = noisy_room + np.random.default_rng(0).normal(0, 0.03, noisy_room.shape).astype(np.float32)
    z, other = noisy_room.astype(float), before.astype(float)
    limit = NOISE + SLOPE * z * z
    clear = ~(abs(abs(z - other) - limit) < 1e-6)
    expected = ~np.isclose(other / limit, z / limit, rtol=0, atol=1)
    changed = kernels.changed_depth(noisy_room, before, NOISE, SLOPE)
    assert_array_equal(changed[clear], expected[clear])
    assert 0.1 < changed.mean() < 0.9


def test_what_is_not_measured_has_changed(kernels: Kernels) -> None:
    """Where one of the two isn't measured, or neither, nothing is known to be as before."""
    depth, before = np.array([[np.nan, 2, np.nan, 2]], np.float32), np.array([[2, np.nan, np.nan, 2]])
    assert_array_equal(kernels.changed_depth(depth, before.astype(np.float32), NOISE, SLOPE), [[1, 1, 1, 0]])


def test_noise_grows_with_the_depth(kernels: Kernels) -> None:
    """At 1 m a step of 10 cm is a change, at 6 m it isn't, by a limit of 2.5 and of 20 cm."""
    depth = np.array([[1, 6]], np.float32)
    assert_array_equal(kernels.changed_depth(depth, depth + np.float32(0.1), NOISE, SLOPE), [[1, 0]])


@pytest.mark.parametrize("name", ["noise", "slope"])
@pytest.mark.parametrize("value", [-0.1, np.nan, np.inf])
def test_refuses_other_noise(kernels: Kernels, name: str, value: float) -> None:
    """Noise that is none is named."""
    one = np.ones((1, 1), np.float32)
    with pytest.raises(ValueError, match=f"{name}: expected a finite number, not negative, got {value:g}"):
        kernels.changed_depth(one, one, **{"noise": NOISE, "slope": SLOPE, name: value})


def test_refuses_another_shape(kernels: Kernels) -> None:
    """An image of another shape is named."""
    with pytest.raises(ValueError, match=r"before: expected shape \(2, 3\), got \(3, 2\)"):
        kernels.changed_depth(np.ones((2, 3), np.float32), np.ones((3, 2), np.float32), NOISE, SLOPE)


@pytest.mark.parametrize("place", [0, 1])
def test_native_refuses_other_arrays(place: int) -> None:
    """Another type is named, not converted."""
    images: list[Any] = [np.ones((2, 2), np.float32)] * 2
    images[place] = images[place].astype(float)
    with pytest.raises(
        TypeError, match=r"(depth|before): expected a float32 depth image \(H, W\), got float64"
    ):
        _core.changed_depth(images[0], images[1], NOISE, SLOPE)
