# SPDX-License-Identifier: MIT
"""P(target | depth) on a grid of places, and what is before the target."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.special import expit
from scipy.stats import norm
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import Place, with_argument

Depth = NDArray[np.float32]

GRIDS = {
    "inside": (3.2, 1.7, 1.3, 17, 9),
    "over the edges": (-9.6, -30.1, 7.3, 20, 33),
    "one square": (2.0, 2.0, 4.0, 1, 1),
    "finer than pixels": (0.1, 0.2, 0.11, 40, 70),
    "far away": (1e300, -1e300, 1e-9, 2, 3),
    "huge steps": (-1e308, 0.0, 1e308, 3, 3),
}


@pytest.mark.parametrize("grid", GRIDS.values(), ids=GRIDS)
@pytest.mark.parametrize("sigma", [0.003, 0.4, 1e4])
def test_native_is_the_twin(picture: Depth, grid: tuple[Any, ...], sigma: float) -> None:
    """Both give the same on any picture and grid: what is nearer exactly, posteriors to 1e-6. The exponent q
    is rounded to 2^-24 of itself, which moves a posterior P by q P (1 - P) 2^-24, at most 1e-7 for any q;
    float32's exponential, quotients and sums are some 2^-24 off each.
    """
    native = _core.depth_posterior(picture, grid, (2.6, sigma, 0.3))
    twin = reference.depth_posterior(picture, grid, (2.6, sigma, 0.3))
    assert [part.dtype for part in native] == [part.dtype for part in twin] == [np.float32, np.uint8]
    assert native[0].shape == native[1].shape == twin[0].shape == grid[3:]
    assert_allclose(native[0], twin[0], atol=1e-6, rtol=0)
    assert_array_equal(native[1], twin[1])


def test_is_bayes_rule(kernels: Kernels) -> None:
    """It is SciPy's logistic function of the log likelihood ratio, by SciPy's Gaussian, at every pixel."""
    depth = np.linspace(0.05, 6, 300, dtype=np.float32).reshape(12, 25)
    posterior, nearer = kernels.depth_posterior(depth, (0.0, 0.0, 1.0, 12, 25), (2.5, 0.35, 0.6))
    z = depth.astype(np.float64)
    ratio = norm.logpdf(z, 2.5, 0.35) - norm.logpdf(2.5, 2.5, 0.35) - np.log(0.1)
    assert_allclose(posterior, expit(ratio), atol=1e-6, rtol=0)
    assert_array_equal(nearer, z < 1.9)


@pytest.mark.parametrize("step", [2, 3])
def test_reads_the_pixel_under_the_center(kernels: Kernels, step: int) -> None:
    """Of squares of whole pixels it takes those of NumPy's slices; shifted grids see shifted pictures."""
    depth = np.random.default_rng(0).uniform(1, 4, (12, 18)).astype(np.float32)
    target = 2.5, 0.5, 0.1
    whole = kernels.depth_posterior(depth, (0.0, 0.0, 1.0, 12, 18), target)
    coarse = kernels.depth_posterior(depth, (0.0, 0.0, float(step), 12 // step, 18 // step), target)
    shifted = kernels.depth_posterior(depth, (4.3, 2.4, 1.0, 12, 18), target)
    for every, some, moved, rest in zip(whole, coarse, shifted, (0.5, 0), strict=True):
        assert_array_equal(some, every[step // 2 :: step, step // 2 :: step])
        assert_array_equal(moved[:-2, :-4], every[2:, 4:])
        assert (moved[-2:] == rest).all()
        assert (moved[:, -4:] == rest).all()


def test_says_nothing_of_what_is_not_measured(kernels: Kernels) -> None:
    """NaN, infinity, 0 and negative depths, and places outside the image, are neutral, and never nearer."""
    depth = np.array([[np.nan, np.inf, -np.inf, 0, -0.0, -2.5]], np.float32)
    posterior, nearer = kernels.depth_posterior(depth, (-1.0, -1.0, 1.0, 3, 8), (2.5, 0.1, 0.0))
    assert (posterior == 0.5).all()
    assert not nearer.any()


def test_falls_with_distance(kernels: Kernels) -> None:
    """It is 1 / 1.1 at the expected depth, the same as far before as behind, and falls to 0 both ways; a
    depth at the margin isn't nearer yet.
    """
    depth = np.array([[1.0, 1.5, 1.75, 2.0, 2.25, 2.5, 3.0, 3e38, 1e-45]], np.float32)
    (posterior,), (nearer,) = kernels.depth_posterior(depth, (0.0, 0.0, 1.0, 1, 9), (2.0, 0.25, 0.5))
    assert posterior[3] == pytest.approx(1 / 1.1, abs=1e-7)
    assert_array_equal(posterior[:3], posterior[6:3:-1][[0, 1, 2]])
    assert (np.diff(posterior[:4]) > 0).all()
    assert posterior[7] < 1e-30
    assert_array_equal(nearer, [1, 0, 0, 0, 0, 0, 0, 0, 1])


BAD: list[tuple[Place, Any, str]] = [
    ((1, 0), np.nan, "x0: expected a finite number, got nan"),
    ((1, 1), np.inf, "y0: expected a finite number, got inf"),
    ((1, 2), 0.0, "step: expected a finite number above 0, got 0"),
    ((1, 3), 0, "rows: expected 1 to 4096, got 0"),
    ((1, 4), -1, "columns: expected 1 to 4096, got -1"),
    ((2, 0), 0.0, "expected: expected a finite number above 0, got 0"),
    ((2, 0), np.nan, "expected: expected a finite number above 0, got nan"),
    ((2, 1), 0.0, "sigma: expected a finite number above 0, got 0"),
    ((2, 1), np.inf, "sigma: expected a finite number above 0, got inf"),
    ((2, 2), -0.1, "occluder_margin: expected a finite number, not negative, got -0.1"),
    ((2, 2), np.nan, "occluder_margin: expected a finite number, not negative, got nan"),
]
GOOD = np.full((4, 5), 2.0, np.float32), (0.0, 0.0, 1.0, 4, 5), (2.0, 0.1, 0.2)


@pytest.mark.parametrize(("place", "value", "message"), BAD)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Numbers out of range are named, with what was expected."""
    with pytest.raises(ValueError, match=message):
        kernels.depth_posterior(*with_argument(GOOD, place, value))


def test_native_refuses_other_arrays() -> None:
    """Other numbers are named, never converted."""
    with pytest.raises(TypeError, match="depth: expected a float32 depth image"):
        _core.depth_posterior(*with_argument(GOOD, 0, np.ones((4, 5))))


def test_native_takes_integers_of_any_kind() -> None:
    """Python's and NumPy's."""
    for number in (4, np.int64(4), np.uint8(4), np.intp(4)):
        assert len(_core.depth_posterior(*with_argument(GOOD, (1, 3), number))[0]) == 4


@pytest.mark.parametrize(
    ("value", "error", "message"),
    [
        (4.0, TypeError, "grid: expected an integer in it, got float"),
        (np.float64(4), TypeError, "grid: expected an integer in it, got numpy.float64"),
        ("4", TypeError, "grid: expected an integer in it, got str"),
        (2**31, ValueError, "grid: expected integers of at most 32 bits in it, got a larger one"),
        (-(2**31) - 1, ValueError, "grid: expected integers of at most 32 bits in it, got a larger one"),
        (2**64 + 4, ValueError, "grid: expected integers of at most 32 bits in it, got a larger one"),
    ],
)
def test_native_refuses_other_numbers_in_a_tuple(value: Any, error: type[Exception], message: str) -> None:
    """A number that isn't an integer, or that has more bits, is named."""
    with pytest.raises(error, match=message):
        _core.depth_posterior(*with_argument(GOOD, (1, 3), value))
