# SPDX-License-Identifier: MIT
"""The explicit skin rule."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Image = NDArray[np.uint8]


def test_twin_decides_the_same(samples: Image) -> None:
    """Native and reference agree for all sizes; the result is float32 (N, n)."""
    native = _core.skin_rule(samples)
    assert native.dtype == np.float32
    assert native.shape == (len(samples), samples.shape[2])
    assert_array_equal(native, reference.skin_rule(samples))


def test_twin_decides_the_same_for_every_color() -> None:
    """Native, which leaves out what other conditions imply, agrees with the printed rule on all colors."""
    green, red = (plane.ravel() for plane in np.mgrid[:256, :256].astype(np.uint8))
    for blue in range(256):
        colors = np.stack([np.full_like(red, blue), green, red])[None]
        assert_array_equal(_core.skin_rule(colors), reference.skin_rule(colors))


# (b, g, r) that is just skin, and what misses one of the seven conditions by one.
COLORS = [
    ((21, 41, 96), 1),
    ((21, 41, 95), 0),
    ((21, 40, 96), 0),
    ((20, 41, 96), 0),
    ((100, 100, 116), 1),
    ((100, 100, 115), 0),
    ((50, 101, 116), 0),
    ((50, 116, 100), 0),
    ((116, 100, 116), 0),
    ((115, 100, 116), 1),
    ((255, 255, 255), 0),
    ((0, 0, 0), 0),
]


@pytest.mark.parametrize(("color", "expected"), COLORS)
def test_borders(kernels: Kernels, color: tuple[int, int, int], expected: int) -> None:
    """Every condition is strict, and one that fails is enough."""
    assert kernels.skin_rule(np.array(color, np.uint8).reshape(1, 3, 1)) == expected


def test_decides_sample_by_sample(kernels: Kernels, samples: Image) -> None:
    """A sample's neighbors don't matter: read the other way round, the decisions turn round too."""
    turned = np.ascontiguousarray(samples[:, :, ::-1])
    assert_array_equal(kernels.skin_rule(turned), kernels.skin_rule(samples)[:, ::-1])


WRONG_TYPE: Any = np.zeros((1, 3, 4))


def test_native_refuses() -> None:
    """Samples of another type or shape are named."""
    with pytest.raises(TypeError, match="samples: expected uint8 samples"):
        _core.skin_rule(WRONG_TYPE)
    with pytest.raises(ValueError, match="samples: expected uint8 samples"):
        _core.skin_rule(np.zeros((3, 4), np.uint8))
