# SPDX-License-Identifier: MIT
"""Learning of a correlation filter that is 0 outside of a mask, and near the one before."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.linalg import lstsq
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float32]
Complexes = NDArray[np.complex64]

SHAPES = [
    (1, 1, 1),
    (1, 1, 8),
    (2, 7, 1),
    (3, 2, 2),
    (2, 5, 9),
    (19, 32, 32),
    (4, 12, 15),
    (3, 31, 22),
    (5, 40, 48),
    (3, 65, 10),
    (2, 12, 75),
]


def box_mask(rows: int, columns: int, size: float) -> Floats:
    """1 in a box of that part of the window's sides, 0 outside, symmetric around its center."""
    down, across = (abs(np.arange(n) + 0.5 - n / 2) <= size * n / 2 for n in (rows, columns))
    return np.outer(down, across).astype(np.float32)


def label_of(rows: int, columns: int) -> Complexes:
    """A Gaussian of a cell's width at (0, 0)."""
    y, x = np.meshgrid(*(np.fft.fftfreq(n, 1 / n) for n in (rows, columns)), indexing="ij")
    return np.ascontiguousarray(np.fft.rfft2(np.exp(-(x**2 + y**2) / 2)), np.complex64)


def case(shape: tuple[int, int, int], seed: int = 0) -> dict[str, Any]:
    """All arguments: cells of noise, a filter of noise that is there already, a soft mask."""
    rng = np.random.default_rng(seed)
    return {
        "cells": rng.uniform(-1, 1, shape).astype(np.float32),
        "mask": rng.random(shape[1:]).astype(np.float32) * box_mask(*shape[1:], 0.6),
        "label": label_of(*shape[1:]),
        "previous": np.ascontiguousarray(np.fft.rfft2(rng.uniform(-0.002, 0.002, shape)), np.complex64),
        "temporal_weight": 3.0,
        "penalty": 1.0,
    }


def rounding_bound(arguments: dict[str, Any], error: float) -> float:
    """How far, as a norm, rounding moves a filter if it moves a transform by `error` of its norm, evenly.

    A = R + x* (Y - x R) / (|x|^2 + w) of a frequency's channels x changes by at most what R does, as the
    factor of R has a norm of at most 1, and (3 |Y| / w + 2 |R| / sqrt(w)) |dx|, as |x| / (|x|^2 + w) is at
    most 1 / (2 sqrt(w)). With masks m in [0, 1] neither G = m A nor H = (1 - m) A is longer than A, nor is
    2 G - A = (2 m - 1) A, which R is made of. The transforms between add `error` twice to G.
    """
    size = arguments["mask"].size
    weight = arguments["penalty"] * size
    label, previous = (np.sqrt(2) * np.linalg.norm(arguments[name]) for name in ("label", "previous"))
    first = previous + label / (2 * np.sqrt(weight))  # at most |A|
    second = first + label / (2 * np.sqrt(weight))

    def solved(known: float) -> float:
        return error * np.linalg.norm(arguments["cells"]) * (3 * label / weight + 2 * known / np.sqrt(weight))

    moved = solved(previous)
    moved_again = moved + 4 * error * first + solved(first)
    return moved_again + moved + 2 * error * first + 2 * error * (second + first)


def agree(arguments: dict[str, Any], error: float) -> None:
    """Native kernel and twin give the same, but for rounding."""
    native, twin = _core.regularized_filter(**arguments), reference.regularized_filter(**arguments)
    assert native.dtype == twin.dtype == np.complex64
    assert native.shape == twin.shape == arguments["previous"].shape
    assert np.linalg.norm(native - twin) <= rounding_bound(arguments, error)


@pytest.mark.parametrize("temporal_weight", [0.0, 16.0])
@pytest.mark.parametrize("shape", SHAPES, ids=str)
def test_native_is_the_twin(
    shape: tuple[int, int, int], temporal_weight: float, fourier_error: Callable[..., float]
) -> None:
    """Both give the same for even, odd and prime sizes and any count of channels, to the error of the
    transforms and 16 roundings around each.
    """
    agree(case(shape) | {"temporal_weight": temporal_weight}, fourier_error(*shape[1:]) + 16 * 2.0**-24)


@pytest.mark.parametrize("shape", [(3, 12, 15), (2, 9, 8), (2, 70, 6)], ids=str)
@pytest.mark.parametrize("part", ["all", "one", "corner", "row", "column", "off the center"])
def test_masks_of_any_form(
    part: str, shape: tuple[int, int, int], fourier_error: Callable[..., float]
) -> None:
    """Native kernel and twin agree wherever the mask is: what saves time where it is 0 changes nothing."""
    mask = np.zeros(shape[1:], np.float32)
    y, x = shape[1] // 2, shape[2] // 2
    places = {
        "all": np.s_[:],
        "one": np.s_[y, x],
        "corner": np.s_[0, 0],
        "row": np.s_[y - 1],
        "column": np.s_[:, x],
        "off the center": np.s_[1:3, x:],
    }
    mask[places[part]] = 0.7
    agree(case(shape) | {"mask": mask}, fourier_error(*shape[1:]) + 16 * 2.0**-24)


@pytest.mark.parametrize("shape", [(1, 4, 3), (2, 3, 4), (3, 5, 4)], ids=str)
def test_is_scipys_least_squares(kernels: Kernels, shape: tuple[int, int, int]) -> None:
    """Both iterations are as SciPy solves them for the filter's own numbers, without Fourier's help: a column
    of the matrix is what one number adds to the response, the shifted cells.
    """
    arguments = case(shape, 2)
    size, sides = shape[1] * shape[2], shape[1:]
    shifts = [divmod(i, shape[2]) for i in range(size)]
    matrix = np.hstack(
        [
            np.stack([np.roll(cell, shift, (0, 1)).ravel() for shift in shifts], axis=1)
            for cell in arguments["cells"].astype(np.float64)
        ]
    )
    label = np.fft.irfft2(arguments["label"], sides).ravel()
    previous = np.fft.irfft2(arguments["previous"], sides).ravel()
    mirrored = np.array([arguments["mask"][-y % sides[0], -x % sides[1]] for y, x in shifts])
    mask = np.tile(mirrored, shape[0])
    masked = dual = np.zeros(shape[0] * size)
    for weight in (1.0 * size, 10.0 * size):
        temporal, penalty = np.sqrt(3.0 * size), np.sqrt(weight)
        rows = [matrix, temporal * np.eye(masked.size), penalty * np.eye(masked.size)]
        wanted = np.concatenate([label, temporal * previous, penalty * (masked - dual)])
        free = lstsq(np.vstack(rows), wanted)[0]
        masked = mask * (free + dual)
        dual = dual + free - masked
    found = np.fft.irfft2(kernels.regularized_filter(**arguments), sides)
    assert_allclose(found, masked.reshape(shape), atol=1e-6 * abs(masked).max())


@pytest.mark.parametrize("shape", [(3, 16, 16), (2, 9, 14), (2, 66, 8)], ids=str)
def test_is_zero_outside_of_the_mask(kernels: Kernels, shape: tuple[int, int, int]) -> None:
    """What the mask leaves out adds nothing to the response in the middle."""
    arguments = case(shape)
    inside = arguments["mask"] > 0
    filters = kernels.regularized_filter(**arguments)[None]
    middle = np.s_[0, shape[1] // 2, shape[2] // 2]
    with_rest = kernels.correlation_response(arguments["cells"], filters)[middle]
    without = kernels.correlation_response(arguments["cells"] * inside, filters)[middle]
    assert with_rest == pytest.approx(without, abs=1e-6)
    assert abs(without) > 0.01
    mirrored = np.fft.irfft2(filters[0], shape[1:])
    weights = abs(np.roll(mirrored[:, ::-1, ::-1], 1, (1, 2)))
    assert weights[:, ~inside].max() <= 1e-6 * weights.max()


def test_finds_a_shift(kernels: Kernels) -> None:
    """What was learned answers in the middle, and shifted cells where they went."""
    for rows, columns in ((32, 32), (15, 22)):
        start = case((19, rows, columns)) | {"temporal_weight": 0.0, "mask": box_mask(rows, columns, 0.6)}
        filters = kernels.regularized_filter(**start)[None]
        for down, across in ((0, 0), (3, -5), (-7, 2)):
            shifted = np.roll(start["cells"], (down, across), (1, 2))
            (answer,) = kernels.correlation_response(shifted, filters)
            peak = np.unravel_index(answer.argmax(), answer.shape)
            assert peak == (rows // 2 + down, columns // 2 + across)


def test_starts_without_a_previous_filter(kernels: Kernels) -> None:
    """Without temporal weight the filter before is none, bit for bit."""
    arguments = case((3, 8, 10)) | {"temporal_weight": 0.0}
    assert_array_equal(
        kernels.regularized_filter(**arguments),
        kernels.regularized_filter(**arguments | {"previous": 0 * arguments["previous"]}),
    )


def test_keeps_to_the_previous_filter(kernels: Kernels) -> None:
    """The greater the weight, the nearer is a filter to the one before, which was 0 outside of the mask."""
    arguments = case((4, 12, 16)) | {"mask": box_mask(12, 16, 0.5), "temporal_weight": 0.0}
    before = kernels.regularized_filter(**arguments)
    arguments |= {"cells": case((4, 12, 16), 7)["cells"], "previous": before}
    steps = [
        np.linalg.norm(kernels.regularized_filter(**arguments | {"temporal_weight": weight}) - before)
        for weight in (0.0, 1.0, 10.0, 100.0, 1e9)
    ]
    assert steps == sorted(steps, reverse=True)
    assert steps[-1] <= 1e-5 * np.linalg.norm(before) < 0.1 * steps[0]


def test_an_empty_mask_leaves_nothing(kernels: Kernels) -> None:
    """Where all is masked out, the filter is 0."""
    arguments = case((3, 6, 8)) | {"mask": np.zeros((6, 8), np.float32)}
    assert not kernels.regularized_filter(**arguments).any()


def test_learns_from_nothing(kernels: Kernels) -> None:
    """Cells of 0 teach nothing: a filter starts as 0."""
    arguments = case((3, 6, 8)) | {"temporal_weight": 0.0, "cells": np.zeros((3, 6, 8), np.float32)}
    assert not kernels.regularized_filter(**arguments).any()


def test_channels_are_equal(kernels: Kernels) -> None:
    """The order of channels is the order of their filters, and a channel of 0 changes no other."""
    arguments = case((5, 10, 12)) | {"temporal_weight": 0.0}
    filters = kernels.regularized_filter(**arguments)
    cells, size = arguments["cells"], 1e-6 * abs(filters).max()
    backward = kernels.regularized_filter(**arguments | {"cells": cells[::-1].copy()})
    assert_allclose(backward[::-1], filters, atol=size)
    more = {
        "cells": np.concatenate([cells, 0 * cells[:1]]),
        "previous": np.zeros((6, 10, 7), np.complex64),
    }
    widened = kernels.regularized_filter(**arguments | more)
    assert_allclose(widened[:5], filters, atol=size)
    assert not widened[5].any()


BAD: list[tuple[dict[str, Any], str]] = [
    (
        {"cells": np.zeros((0, 4, 6), np.float32)},
        r"cells: expected at least one channel and cell, got \(0, 4, 6\)",
    ),
    ({"mask": np.zeros((4, 4), np.float32)}, r"mask: expected shape \(4, 6\), got \(4, 4\)"),
    ({"label": np.zeros((4, 6), np.complex64)}, r"label: expected shape \(4, 4\), got \(4, 6\)"),
    (
        {"previous": np.zeros((1, 4, 4), np.complex64)},
        r"previous: expected shape \(2, 4, 4\), got \(1, 4, 4\)",
    ),
    (
        {"previous": np.zeros((2, 4, 6), np.complex64)},
        r"previous: expected shape \(2, 4, 4\), got \(2, 4, 6\)",
    ),
    ({"temporal_weight": -1.0}, "temporal_weight: expected a finite number, not negative, got -1"),
    ({"temporal_weight": float("nan")}, "temporal_weight: expected a finite number, not negative, got nan"),
    ({"temporal_weight": float("inf")}, "temporal_weight: expected a finite number, not negative, got inf"),
    ({"penalty": 0.0}, "penalty: expected a finite number above 0, got 0"),
    ({"penalty": float("nan")}, "penalty: expected a finite number above 0, got nan"),
    ({"penalty": float("inf")}, "penalty: expected a finite number above 0, got inf"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Wrong shapes and numbers are named, with what was expected."""
    with pytest.raises(ValueError, match=message):
        kernels.regularized_filter(**case((2, 4, 6)) | changes)


def test_native_refuses_other_arrays() -> None:
    """Other numbers and layouts are named, never converted."""
    good = case((2, 4, 6))
    with pytest.raises(TypeError, match="mask: expected float32"):
        _core.regularized_filter(**good | {"mask": np.zeros((4, 6))})
    with pytest.raises(TypeError, match="previous: expected complex64"):
        _core.regularized_filter(**good | {"previous": np.zeros((2, 4, 4), np.complex128)})
    with pytest.raises(ValueError, match="label: expected complex64"):
        _core.regularized_filter(**good | {"label": np.zeros((1, 4, 4), np.complex64)})
    with pytest.raises(ValueError, match="cells: expected a C-contiguous"):
        _core.regularized_filter(**good | {"cells": np.zeros((6, 4, 2), np.float32).T})
