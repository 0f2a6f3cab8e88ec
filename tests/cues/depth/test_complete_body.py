# SPDX-License-Identifier: MIT
"""A body from its pieces, and completed where something cuts it. What the tracker makes of it is in
tests/track/depth_particle/test_body.py.
"""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import with_parts

Floats = NDArray[np.float64]
Case = dict[str, Any]
PARTS = {"objects": ("measured", "cut", "columns", "rows"), "expected": ("state", "size", "known")}
EXPECTED = np.array([0.0, 0.0, 3.0, 0.6, 1.8])
BODY, LEG = [0.0, -0.3, 3.0, 0.6, 1.2], [0.1, 0.6, 3.2, 0.2, 0.5]
BINS = 4


def case(states: Any, **changes: Any) -> Case:
    """All arguments: whole objects of these states, and a body of known size."""
    five = np.array(states, np.float64).reshape(-1, 5)
    even = np.full((len(five), BINS), 1 / BINS, np.float32)
    usual: Case = {
        "objects": (
            np.column_stack([five, np.zeros((len(five), 2)), five[:, 3] * five[:, 4]]),
            np.zeros((len(five), 4), np.bool_),
            even,
            even.copy(),
        ),
        "index": 0,
        "expected": (EXPECTED, EXPECTED[3:].copy(), np.array([True, True])),
        "limits": (1.3, 0.8, 1.15, 0.4),
    }
    return with_parts(usual, PARTS, changes)


def random_case(seed: int) -> Case:
    """A body in pieces of any size in and around the expected rectangle, some of them cut."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 9))
    states = EXPECTED + rng.normal(0, [0.15, 0.5, 0.3, 0.3, 0.8], (count, 5))
    states[:, 2:] = np.maximum(abs(states[:, 2:]), 0.05)
    values = case(
        states,
        cut=rng.random((count, 4)) < 0.2,
        columns=rng.dirichlet(np.ones(BINS), count).astype(np.float32),
        index=int(rng.integers(count)),
        size=EXPECTED[3:] * rng.uniform(0.7, 1.3, 2),
        known=rng.random(2) < 0.5,
        limits=(float(rng.uniform(1, 2)), float(rng.uniform(0.3, 1)), 1.15, float(rng.uniform(0, 1))),
    )
    values["objects"][0][:, 5:7] = rng.normal(0, 0.1, (count, 2))
    return values


@given(st.integers(0, 2**32))
def test_twin_makes_the_same(seed: int) -> None:
    """Native and reference join the same pieces, and complete them in the same way.

    A length is the sum of a few below 8 m, rounded some ten times: 1e-14 m.
    """
    values = random_case(seed)
    native, twin = _core.complete_body(**values), reference.complete_body(**values)
    for one, other in zip(native, twin, strict=True):
        assert one.dtype == other.dtype
        assert_allclose(one, other, rtol=0, atol=1e-14)


def test_those_cases_have_pieces() -> None:
    """In some of these cases pieces are joined, and in some a body is completed."""
    cases = [random_case(seed) for seed in range(40)]
    bodies = [_core.complete_body(**each) for each in cases]
    own = [each["objects"][0][each["index"]] for each in cases]
    assert any((body[3][-2:] != each[5:7]).any() for body, each in zip(bodies, own, strict=True))
    assert any(not body[1].all() for body in bodies)


def test_the_box_is_that_around_all_pieces_in_the_image(kernels: Kernels) -> None:
    """At a focal length of 1 the sides of a rectangle are at (X - W / 2) / Z: those of the joined one are the
    outermost, whatever the pieces' depths.
    """
    state, whole, size, signature = kernels.complete_body(**case([BODY, LEG]))
    pieces = np.array([BODY, LEG])
    first = ((pieces[:, :2] - pieces[:, 3:] / 2) / pieces[:, 2:3]).min(axis=0)
    last = ((pieces[:, :2] + pieces[:, 3:] / 2) / pieces[:, 2:3]).max(axis=0)
    assert_allclose((state[:2] - state[3:] / 2) / 3, first, rtol=1e-12)
    assert_allclose((state[:2] + state[3:] / 2) / 3, last, rtol=1e-12)
    assert whole.all()
    assert_array_equal(size, EXPECTED[3:])
    centroid = np.average(pieces[:, :2], axis=0, weights=pieces[:, 3] * pieces[:, 4])
    assert_allclose(state[:2] + signature[-2:], centroid, atol=1e-12)


@pytest.mark.parametrize("side", range(4))
def test_what_is_cut_grows_there(kernels: Kernels, side: int) -> None:
    """A half that is cut at its middle is the whole rectangle, and nothing else of it changes."""
    axis, sense = side // 2, -1 if side % 2 else 1
    half = EXPECTED.copy()
    half[3 + axis] /= 2
    half[axis] += sense * half[3 + axis] / 2
    state, whole, *_ = kernels.complete_body(**case([half], cut=np.arange(4)[None] == side))
    assert_allclose(state, EXPECTED, atol=1e-12)
    assert_array_equal(whole, np.arange(2) != axis)


def test_a_lower_bound_grows(kernels: Kernels) -> None:
    """A size that isn't known is at least that of the object, and what is cut is completed to it."""
    narrow, known = np.array([0.3, 1.8]), np.array([False, True])
    _, _, size, _ = kernels.complete_body(**case([BODY], size=narrow, known=known))
    assert_array_equal(size, [0.6, 1.8])
    _, _, size, _ = kernels.complete_body(**case([BODY], size=narrow))
    assert_array_equal(size, [0.3, 1.8])


BAD: list[tuple[Case, str]] = [
    ({"measured": np.ones((1, 7))}, r"measured: expected shape \(1, 8\), got \(1, 7\)"),
    ({"measured": np.zeros((1, 8))}, "measured: expected depths, sizes and areas above 0, got 0"),
    ({"cut": np.zeros((2, 4), np.bool_)}, "cut: expected 1 rows, got 2"),
    ({"index": 1}, r"index: expected a number in \[0, 1\), got 1"),
    ({"index": -1}, r"index: expected a number in \[0, 1\), got -1"),
    ({"limits": (np.nan, 0.8, 1.15, 0.4)}, "limits: expected numbers, got nan"),
    ({"state": np.ones(4)}, r"state: expected shape \(5,\), got \(4,\)"),
    ({"size": np.array([-1.0, 1.0])}, "size: expected numbers above 0, got -1"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: Case, message: str) -> None:
    """What it can't work with is named."""
    with pytest.raises(ValueError, match=message):
        kernels.complete_body(**case([BODY], **changes))


def test_native_refuses_other_arrays() -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match="measured: expected float64"):
        _core.complete_body(**case([BODY], measured=np.ones((1, 8), np.float32)))
