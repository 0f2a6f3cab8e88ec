# SPDX-License-Identifier: MIT
"""How much a flow field stretches."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Plane = NDArray[np.float32]
NAN = np.float32(np.nan)


def stretched(
    a: float, shape: tuple[int, int] = (24, 31), noise: float = 0.0, seed: int = 0, shift: float = 1.7
) -> tuple[Plane, Plane]:
    """Flow of a field whose places were a times as far apart, and moved, with noise in pixels."""
    rng = np.random.default_rng(seed)
    y, x = np.mgrid[: shape[0], : shape[1]]
    u, v = ((1 - a) * each + by + noise * rng.normal(size=shape) for each, by in ((x, shift), (y, -shift)))
    return u.astype(np.float32), v.astype(np.float32)


def with_gaps(u: Plane, v: Plane, share: float, seed: int = 0) -> tuple[Plane, Plane]:
    """NaN and infinity in so many pixels of each."""
    rng = np.random.default_rng(seed)
    u, v = u.copy(), v.copy()
    for plane in (u, v):
        plane[rng.random(plane.shape) < share] = NAN
        plane[rng.random(plane.shape) < share / 10] = rng.choice([-np.inf, np.inf])
    return u, v


def least_squares(u: Plane, v: Plane, kept: NDArray[np.bool_]) -> tuple[float, NDArray[np.float64]]:
    """a by LAPACK on the design matrix, and all squared residuals."""
    y, x = (each.astype(np.float64) for each in np.indices(u.shape))
    one, none = np.ones_like(x), np.zeros_like(x)
    design = np.stack([np.stack([x, one, none], axis=-1), np.stack([y, none, one], axis=-1)])
    moved = np.stack([x - u, y - v])
    found = np.linalg.lstsq(design[:, kept].reshape(-1, 3), moved[:, kept].ravel(), rcond=None)[0]
    return float(found[0]), ((moved - design @ found) ** 2).sum(axis=0)


@pytest.mark.parametrize("seed", range(24))
def test_native_is_the_twin(seed: int) -> None:
    """Both give the same bits at any shape, flow, gaps and limits, as both add in the same order."""
    rng = np.random.default_rng(seed)
    shape = int(rng.integers(0, 40)), int(rng.integers(0, 40))
    flow = stretched(float(rng.uniform(0.5, 2)), shape, float(rng.choice([0, 0.1, 10])), seed)
    flow = with_gaps(*flow, float(rng.uniform(0, 0.6)), seed)
    outliers, least = float(rng.uniform(0.3, 3)), int(rng.integers(1, 60))
    native = _core.flow_scale(*flow, outliers, least)
    twin = reference.flow_scale(*flow, outliers, least)
    assert [type(each) for each in native] == [type(each) for each in twin] == [float, float, int]
    assert_array_equal(native, twin)


@pytest.mark.parametrize("shape", [(0, 0), (0, 5), (5, 0), (1, 1), (1, 2), (2, 1), (1, 9), (3, 3), (2, 4)])
def test_small_planes(kernels: Kernels, shape: tuple[int, int]) -> None:
    """From two pixels on, in whatever direction, there is a scale; of one and of none nothing is told."""
    a, spread, count = kernels.flow_scale(*stretched(0.75, shape, shift=0.5), 2.5, 1)
    assert count == shape[0] * shape[1]
    if count < 2:
        assert np.isnan([a, spread]).all()
    else:  # quarters are exact in float32
        assert_allclose([a, spread], [0.75, 0], atol=1e-14)


@pytest.mark.parametrize("a", [0.6, 0.97, 1.0, 1.015, 1.8])
@pytest.mark.parametrize("shift", [0.0, -40.0])
def test_finds_a_known_scale(kernels: Kernels, a: float, shift: float) -> None:
    """A field that was made with a has it, whatever the shift, to what 32 bits leave of the flow."""
    found, spread, count = kernels.flow_scale(*with_gaps(*stretched(a, shift=shift), 0.2), 10, 30)
    assert found == pytest.approx(a, abs=1e-6)
    assert spread < 1e-10
    assert count > 400


@pytest.mark.parametrize("seed", range(6))
def test_is_least_squares_twice(kernels: Kernels, seed: int) -> None:
    """Scale and spread are those of LAPACK's least squares, and of a second one without the outliers.

    To 1e-12, some thousand roundings of float64.
    """
    u, v = with_gaps(*stretched(1.03, (29, 22), 0.1, seed), 0.1, seed)
    u[3:8, 2:9] += 2
    known = np.isfinite(u) & np.isfinite(v)
    _, squares = least_squares(u, v, known)
    kept = known & (squares <= 1.5**2 * squares[known].mean())
    a, squares = least_squares(u, v, kept)
    found = kernels.flow_scale(u, v, 1.5, 30)
    assert found[2] == kept.sum() < known.sum()
    assert_allclose(found[:2], [a, squares[kept].mean()], rtol=1e-12)


def test_standing_still_is_exact(kernels: Kernels) -> None:
    """Without any flow all pixels stay, the scale is 1, and nothing is spread."""
    assert kernels.flow_scale(*np.zeros((2, 20, 30), np.float32), 2.5, 30) == (1, 0, 600)


def test_outliers_do_not_count(kernels: Kernels) -> None:
    """A tenth of the pixels that move on their own change what a fit of all finds, and not what is found."""
    u, v = stretched(1.02, noise=0.01)
    u[:8, :9] += 3
    everything = least_squares(u, v, np.isfinite(u))[0]
    a, spread, count = kernels.flow_scale(u, v, 1.5, 30)
    assert abs(everything - 1.02) > 0.02
    assert a == pytest.approx(1.02, abs=2e-3)
    assert count == u.size - 72
    assert spread == pytest.approx(2 * 0.01**2, rel=0.2)


@pytest.mark.parametrize("outliers", [1.1, 2.5, 1e200, 1.7e308])
def test_most_pixels_stay(kernels: Kernels, outliers: float) -> None:
    """Chebyshev: at most 1 / outliers² of the pixels is lost; by a limit beyond all numbers none is."""
    for seed in range(5):
        u, v = stretched(1.0, noise=3.0, seed=seed)
        count = kernels.flow_scale(u**3, v**3, outliers, 1)[2]
        assert (1 - 1 / outliers / outliers) * u.size <= count <= u.size
        assert count == u.size or outliers < 10


def test_axes_and_signs_do_not_matter(kernels: Kernels) -> None:
    """A field that is transposed, mirrored or moved as a whole has the same scale, to rounding."""
    u, v = with_gaps(*stretched(1.04, noise=0.2), 0.1)
    expected = kernels.flow_scale(u, v, 2.0, 30)
    mirrored = np.ascontiguousarray(-u[:, ::-1]), np.ascontiguousarray(v[:, ::-1])
    transposed = np.ascontiguousarray(v.T), np.ascontiguousarray(u.T)
    for flow in (mirrored, transposed, (u + np.float32(64), v)):
        assert_allclose(kernels.flow_scale(*flow, 2.0, 30), expected, rtol=1e-4)
    assert kernels.flow_scale(*transposed, 2.0, 30)[2] == expected[2]


def test_too_few_pixels_tell_nothing(kernels: Kernels) -> None:
    """`min_pixels` holds for both fits, and the count says how many there were."""
    u, v = stretched(1.02, (6, 5), 0.01)
    u[0, 0] = NAN
    v[0, 1] = NAN
    v[3, 3] = 9
    assert kernels.flow_scale(u, v, 2.5, 27)[2] == 27
    for least, count in ((28, 27), (29, 28)):
        a, spread, left = kernels.flow_scale(u, v, 2.5, least)
        assert np.isnan([a, spread]).all()
        assert left == count


def test_rows_may_be_padded(kernels: Kernels) -> None:
    """A part of a plane gives what a copy of it does."""
    flow = with_gaps(*stretched(1.02, noise=0.1), 0.1)
    parts = [plane[2:20, 3:26] for plane in flow]
    assert kernels.flow_scale(*parts, 2.5, 30) == kernels.flow_scale(
        *(each.copy() for each in parts), 2.5, 30
    )


def test_arguments_stay(kernels: Kernels) -> None:
    """The flow is read only."""
    flow = with_gaps(*stretched(1.02, noise=0.1), 0.1)
    before = [plane.copy() for plane in flow]
    kernels.flow_scale(*flow, 1.5, 30)
    assert_array_equal(flow, before)


def test_huge_flow_does_not_overflow(kernels: Kernels) -> None:
    """Flow as long as a float32 can be still has finite sums."""
    u, v = (plane * np.float32(1e35) for plane in stretched(0.5, noise=1.0))
    assert np.isfinite(kernels.flow_scale(u, v, 2.5, 30)).all()


BAD: list[tuple[dict[str, Any], str]] = [
    ({"v": np.zeros((4, 5), np.float32)}, r"v: expected u's shape \(5, 4\), got \(4, 5\)"),
    ({"outliers": 0.0}, "outliers: expected a finite number above 0, got 0"),
    ({"outliers": float("nan")}, "outliers: expected a finite number above 0, got nan"),
    ({"outliers": float("inf")}, "outliers: expected a finite number above 0, got inf"),
    ({"min_pixels": 0}, "min_pixels: expected at least 1 pixel, got 0"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    u, v = np.zeros((2, 5, 4), np.float32)
    with pytest.raises(ValueError, match=message):
        kernels.flow_scale(**{"u": u, "v": v, "outliers": 2.5, "min_pixels": 3} | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers, ranks and layouts are named, never converted."""
    u, v = stretched(1.0)
    with pytest.raises(TypeError, match="u: expected float32 flow"):
        _core.flow_scale(u.astype(np.float64), v, 2.5, 30)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="v: expected float32 flow"):
        _core.flow_scale(u, v[0], 2.5, 30)
    with pytest.raises(ValueError, match="u: expected packed pixels"):
        _core.flow_scale(u[:, ::2], v[:, ::2], 2.5, 30)
