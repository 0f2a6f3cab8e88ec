# SPDX-License-Identifier: MIT
"""A target's place in a patch."""

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import Place, argument, with_argument

Plane = NDArray[np.float32]
NO_TABLE: Plane = np.empty((0, 0, 0), np.float32)
NONE: Plane = np.empty((0, 0), np.float32)
PATCH, TAPER, APPEARANCE, OTHER, SEARCH = range(5)
FILTERS, TABLE, ROOTS = (APPEARANCE, 0), (APPEARANCE, 1), (APPEARANCE, 2)
WIDTH, INNER = (SEARCH, 0), (SEARCH, 6)


def arguments(seed: int, rows: int = 32, columns: int = 32, filters: int = 2, bins: int = 16) -> list[Any]:
    """Of a patch of noise, and a target that is like it."""
    rng = np.random.default_rng(seed)
    patch = rng.integers(0, 256, (2 * rows, 2 * columns, 3), np.uint8)
    taper = rng.random((rows, columns), np.float32)
    weights = rng.uniform(-1, 1, (filters, 19, rows, columns)) / rows / columns
    spectra = np.ascontiguousarray(np.fft.rfft2(weights), np.complex64)
    table, other = rng.random((bins, bins, bins), np.float32), rng.random((2 * rows, 2 * columns), np.float32)
    histogram = rng.random(bins**3)
    roots = np.sqrt(histogram / histogram.sum())
    box = rng.uniform(3, 30), rng.uniform(3, 30), rng.uniform(1.2, 2), rng.uniform(0, 1)
    return [patch, taper, (spectra, table, roots), other, (*box, 0.7, 0.3, 0.8)]


@pytest.mark.parametrize("given", ["both", "colors", "other", "neither"])
@pytest.mark.parametrize("shape", [(32, 32), (8, 11), (33, 6)], ids=str)
def test_native_is_the_twin(shape: tuple[int, int], given: str) -> None:
    """Both find the same place, and the same of it, to the responses' roundings, with any of the cues."""
    for seed in range(8):
        each = arguments(seed, *shape, filters=1 + seed % 3, bins=2 ** (seed % 5))
        if given in ("other", "neither"):
            each = with_argument(each, TABLE, NO_TABLE)
        if given in ("colors", "neither"):
            each[OTHER] = NONE
        native, answers = _core.localize_target(*each)
        twin, expected = reference.localize_target(*each)
        assert native.shape == twin.shape == (7 + len(expected),)
        assert answers.dtype == expected.dtype == np.float32
        assert_allclose(answers, expected, atol=1e-5 * abs(expected).max())
        # A peak between cells is a quotient of differences, of which the responses' roundings are a part.
        assert_allclose(native[:2], twin[:2], atol=2e-3)
        assert_allclose(native[2:], twin[2:], rtol=1e-4, atol=1e-5)


def test_is_its_parts(kernels: Kernels) -> None:
    """It gives what the kernels that it stands for give one after the other, to the last bit."""
    patch, taper, (filters, table, _), other, search = arguments(3)
    found, answers = kernels.localize_target(*arguments(3))
    expected = kernels.correlation_response(kernels.hog_color_cells(patch, taper), filters)
    assert_array_equal(answers, expected)
    posterior = kernels.combine_posteriors(kernels.color_posterior(patch, table), other)
    contrast = kernels.box_contrast(posterior, *search[:4])
    assert_array_equal(found[:-2], kernels.evidence_peak(expected, contrast, 0.7, 0.3))


def test_sharpness(kernels: Kernels) -> None:
    """A peak stands as high above the mean as NumPy's standard deviation has it; one that is no higher than
    the rest isn't sharp.
    """
    each = arguments(5)
    found, answers = kernels.localize_target(*each)
    response = answers[0].astype(float)
    assert found[-2] == pytest.approx((found[5] - response.mean()) / response.std(), rel=1e-6)
    silent = with_argument(each, FILTERS, np.zeros_like(argument(each, FILTERS)))
    assert kernels.localize_target(*silent)[0][-2] == 0


@pytest.mark.parametrize(
    ("right", "similarity"), [(-8, 1.0), (8, 0.0), (0, 0.5**0.5), (-15, 1.0), (15, 0.0)], ids=str
)
def test_colors_are_compared_at_the_place(kernels: Kernels, right: int, similarity: float) -> None:
    """The left half of a patch has the first frame's color, the right half another: there, the Bhattacharyya
    coefficient is 1 and 0, and on half of both the root of a half. The place is that of a bright box.
    """
    patch, taper, (filters, *_), *_ = arguments(5)
    patch[:, :32], patch[:, 32:] = (200, 20, 120), (40, 90, 250)
    other = np.zeros((64, 64), np.float32)
    other[26:38, 26 + right : 38 + right] = 1
    roots = np.zeros(4096)
    roots[(200 // 16 * 16 + 20 // 16) * 16 + 120 // 16] = 1
    search = 12.0, 12.0, 1.5, 0.5, 0.0, 1.0, 0.8
    found, _ = kernels.localize_target(patch, taper, (filters, NO_TABLE, roots), other, search)
    assert found[:2].tolist() == pytest.approx([right / 2, 0], abs=0.5)
    assert found[-1] == pytest.approx(similarity, abs=1e-6 if right else 0.05)


ONE_TOO_SMALL = np.zeros((62, 64, 3), np.uint8)


@pytest.mark.parametrize(
    ("place", "value", "message"),
    [
        (PATCH, ONE_TOO_SMALL, "other: expected the patch's rows and columns|patch: expected shape"),
        (OTHER, np.zeros((64, 63), np.float32), "other: expected the patch's rows and columns"),
        (FILTERS, np.zeros((0, 19, 32, 17), np.complex64), "filters: expected at least one filter"),
        (TABLE, np.zeros((3, 3, 3), np.float32), "table: expected shape"),
        (ROOTS, np.zeros(5), r"roots: expected \(B³,\), B a power of two up to 64, got 5"),
        (WIDTH, 0.0, "width: expected a finite number above 0, got 0"),
        (INNER, np.nan, "inner: expected a finite number above 0, got nan"),
    ],
)
def test_refuses(kernels: Kernels, place: Place, value: Any, message: str) -> None:
    """Wrong shapes and values are named."""
    with pytest.raises(ValueError, match=message):
        kernels.localize_target(*with_argument(arguments(0), place, value))
