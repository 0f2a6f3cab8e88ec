# SPDX-License-Identifier: MIT
"""Distance of rank sections."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.spatial.distance import cdist
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float32]
# Sums of S squares in another order, then a root: relative errors of S/2 and a few more roundings.
ROUNDING = 32 * np.finfo(float).eps

shares = st.floats(0, 1, width=32)


def random_sections(rows: int, sections: int = 16) -> Floats:
    """Rows of three channels, each of sum 1."""
    sums = np.random.default_rng(rows).exponential(size=(rows, 3, sections))
    shares: Floats = (sums / sums.sum(axis=2, keepdims=True)).astype(np.float32)
    return shares


@given(arrays(np.float32, (3, 3, 16), elements=shares), arrays(np.float32, (3, 16), elements=shares))
def test_twin_measures_the_same(sections: Floats, model: Floats) -> None:
    """Native and reference agree within the rounding of sums of 16 squares."""
    native, twin = _core.section_distance(sections, model), reference.section_distance(sections, model)
    assert_allclose(native, twin, rtol=ROUNDING)


@pytest.mark.parametrize(("rows", "sections"), [(0, 4), (1, 1), (100, 16), (7, 33)])
def test_agrees_with_scipy(kernels: Kernels, rows: int, sections: int) -> None:
    """SciPy's Euclidean distance of each channel, summed, over 3 sqrt 2, for none, one and many ellipses."""
    a, model = random_sections(rows, sections), random_sections(1, sections)[0]
    baseline = sum(cdist(a[:, k].astype(float), model[None, k].astype(float))[:, 0] for k in range(3))
    assert_allclose(kernels.section_distance(a, model), baseline / (3 * np.sqrt(2)), rtol=1e-13)


def test_same_and_disjoint(kernels: Kernels) -> None:
    """Sections are 0 from themselves; each channel with nothing in common adds 1/3."""
    first, second = np.eye(4, dtype=np.float32)[:2]
    sections = np.array([[first] * 3, [first, second, second], [first, first, second]])
    distances = kernels.section_distance(sections, sections[0])
    assert_allclose(distances, [0, 2 / 3, 1 / 3], rtol=1e-15)
    assert_allclose(kernels.section_distance(sections[:1], np.array([second] * 3)), 1, rtol=1e-15)


def test_a_metric(kernels: Kernels) -> None:
    """Symmetric, in [0, 1], and no detour is shorter."""
    sections = random_sections(12)
    distances = np.array([kernels.section_distance(sections, model) for model in sections])
    assert_array_equal(distances, distances.T)
    assert distances.max() <= 1
    assert_array_equal(np.diag(distances), np.zeros(12))
    detours = (distances[:, :, None] + distances[None, :, :]).min(axis=1)
    assert (distances <= detours + ROUNDING).all()


def test_refuses_another_number_of_sections(kernels: Kernels) -> None:
    """A model of other sections is an error that says so."""
    with pytest.raises(ValueError, match="model: expected 16 sections, as in sections, got 8"):
        kernels.section_distance(random_sections(2), random_sections(1, 8)[0])


GOOD = random_sections(2)
BAD: list[tuple[Any, Any, type[Exception], str]] = [
    (GOOD.astype(float), GOOD[0], TypeError, r"sections: expected float32 \(N, 3, S\), got float64"),
    (GOOD[:, :2].copy(), GOOD[0], ValueError, r"sections: expected float32 \(N, 3, S\)"),
    (GOOD, GOOD, ValueError, r"model: expected float32 \(3, S\), got float32 \(2, 3, 16\)"),
    (GOOD, GOOD[0, :2], ValueError, r"model: expected float32 \(3, S\)"),
    (GOOD[:, :, ::2], GOOD[0], ValueError, "sections: expected a C-contiguous"),
]


@pytest.mark.parametrize(("sections", "model", "error", "message"), BAD)
def test_native_refuses(sections: Any, model: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.section_distance(sections, model)
