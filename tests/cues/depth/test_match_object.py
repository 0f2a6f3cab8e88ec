# SPDX-License-Identifier: MIT
"""Which of the segmented objects is the target. What the tracker makes of it is in
tests/track/depth_particle/test_matching.py.
"""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.distance import mahalanobis
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import with_parts

Floats = NDArray[np.float64]
Case = dict[str, Any]
PARTS = {
    "objects": ("measured", "cut", "columns", "rows"),
    "expected": ("state", "size", "known"),
    "costs": ("deviation", "unknown", "signature_cost", "max_cost", "min_area"),
}
TARGET = np.array([0.2, -0.1, 3.0, 0.6, 1.7])
DEVIATION = np.array([0.2, 0.4, 0.2, 0.2 * 0.6 + 0.05, 0.2 * 1.7 + 0.05])
BINS = 4
FAR_APART = 1e9


def case(states: Floats, **changes: Any) -> Case:
    """All arguments: whole objects of these states and an even distribution, and a target of known size."""
    count = len(states)
    even = np.full((count, BINS), 1 / BINS, np.float32)
    usual: Case = {
        "objects": (
            np.column_stack([states, np.zeros((count, 2)), np.ones(count)]),
            np.zeros((count, 4), np.bool_),
            even,
            even.copy(),
        ),
        "others": np.empty(0),
        "expected": (TARGET, TARGET[3:].copy(), np.array([True, True])),
        "signature": np.append(np.full(2 * BINS, 1 / BINS), [0.0, 0.0]),
        "costs": ((0.2, 0.4, 0.2, 0.2, 0.05), (0.5, 0.3), 3.0, 8.0, 0.2),
        "complete": True,
    }
    return with_parts(usual, PARTS, changes)


def random_case(seed: int) -> Case:
    """Objects around the target, some of them cut, some far off or small, by any distribution."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(0, 12))
    states = TARGET + rng.normal(0, rng.choice([0.05, 0.3, 2.0]), (count, 5))
    states[:, 2:] = np.maximum(states[:, 2:], 0.1)
    return case(
        states,
        cut=rng.random((count, 4)) < 0.3,
        columns=rng.dirichlet(np.ones(BINS), count).astype(np.float32).reshape(count, BINS),
        rows=rng.dirichlet(np.ones(BINS), count).astype(np.float32).reshape(count, BINS),
        others=rng.choice([0.0, 0.5, np.inf], count) if seed % 2 else np.empty(0),
        size=rng.uniform(0.3, 2, 2),
        known=rng.random(2) < 0.5,
        max_cost=float(rng.choice([1.0, 8.0, np.inf])),
        min_area=float(rng.choice([0.0, 0.5])),
        complete=bool(rng.random() < 0.7),
    )


@given(st.integers(0, 2**32))
def test_twin_finds_the_same(seed: int) -> None:
    """Native and reference take the same object, whatever is cut, known or costs more."""
    values = random_case(seed)
    assert _core.match_object(**values) == reference.match_object(**values)


def test_those_cases_have_both(kernels: Kernels) -> None:
    """In some of these cases an object is the target, in others none is."""
    found = [kernels.match_object(**random_case(seed)) for seed in range(40)]
    assert min(found) == -1
    assert max(found) > 1


def test_agrees_with_scipy(kernels: Kernels) -> None:
    """The object of the least Mahalanobis distance is the target, where it is below what the gate says."""
    rng = np.random.default_rng(1)
    inverse = np.diag(1 / DEVIATION**2)
    for _ in range(20):
        states = TARGET + rng.normal(0, 0.15, (9, 5))
        distances = np.array([mahalanobis(each, TARGET, inverse) for each in states])
        best, least = int(distances.argmin()), float(distances.min()) ** 2 / 2
        assert kernels.match_object(**case(states, max_cost=FAR_APART, min_area=0.0)) == best
        assert kernels.match_object(**case(states, max_cost=least * (1 + 1e-9), min_area=0.0)) == best
        assert kernels.match_object(**case(states, max_cost=least * (1 - 1e-9), min_area=0.0)) == -1


def test_another_distribution_costs_more(kernels: Kernels) -> None:
    """Half of the columns elsewhere are a quarter of the greatest distance, and cost as much; of what is cut
    none of it counts.
    """
    changes: Case = {"columns": np.array([[0.5, 0.5, 0, 0]], np.float32), "min_area": 0.0}
    for limit, index in ((3.0 / 4 * (1 + 1e-9), 0), (3.0 / 4, -1)):
        assert kernels.match_object(**case(TARGET[None], **changes, max_cost=limit)) == index
    cut = np.array([[False, False, False, True]])
    assert kernels.match_object(**case(TARGET[None], **changes, max_cost=1e-9, cut=cut)) == 0


@pytest.mark.parametrize("changes", [{"others": np.array([0.0, -99.0])}, {"signature_cost": -99.0}])
def test_less_on_top_counts_too(kernels: Kernels, changes: Case) -> None:
    """An object that is too far away is the target if what is added to its cost is negative enough."""
    columns = np.array([[0.25, 0.25, 0.25, 0.25], [1, 0, 0, 0]], np.float32)
    values = case(np.array([TARGET, TARGET + [0, 0, 1, 0, 0]]), columns=columns, **changes)
    assert kernels.match_object(**values) == 1


def test_the_first_of_equals_is_taken(kernels: Kernels) -> None:
    """Of equal objects the first, which is the largest, is the target; without objects none is."""
    assert kernels.match_object(**case(np.array([TARGET, TARGET]))) == 0
    assert kernels.match_object(**case(np.empty((0, 5)))) == -1


BAD: list[tuple[Case, str]] = [
    ({"measured": np.ones((1, 7))}, r"measured: expected shape \(1, 8\), got \(1, 7\)"),
    ({"measured": np.full((1, 8), np.nan)}, "measured: expected finite numbers, got nan"),
    ({"cut": np.zeros((2, 4), np.bool_)}, "cut: expected 1 rows, got 2"),
    ({"columns": np.ones((2, BINS), np.float32)}, "columns: expected 1 rows, got 2"),
    ({"rows": np.ones((2, BINS), np.float32)}, "rows: expected 1 rows, got 2"),
    ({"rows": np.ones((1, 3), np.float32)}, "rows: expected 4 bins, got 3"),
    ({"others": np.ones(2)}, r"others: expected shape \(1,\), got \(2,\)"),
    ({"state": np.ones(4)}, r"state: expected shape \(5,\), got \(4,\)"),
    ({"state": np.full(5, np.inf)}, "state: expected finite numbers, got inf"),
    ({"size": np.ones(3)}, r"size: expected shape \(2,\), got \(3,\)"),
    ({"size": np.array([1.0, 0.0])}, "size: expected numbers above 0, got 0"),
    ({"signature": np.ones(9)}, r"signature: expected shape \(10,\), got \(9,\)"),
    ({"deviation": (0.0, 1.0, 1.0, 1.0, 1.0)}, "x: expected a finite number above 0, got 0"),
    ({"deviation": (1.0, 1.0, np.nan, 1.0, 1.0)}, "z: expected a finite number above 0, got nan"),
    ({"deviation": (1.0, 1.0, 1.0, -1.0, 1.0)}, "share: expected a finite number, not negative, got -1"),
    ({"deviation": (1.0, 1.0, 1.0, 0.0, 0.0)}, "base: expected a number above 0 where share is 0, got 0"),
    ({"unknown": (np.inf, 1.0)}, "center: expected a finite number, got inf"),
    ({"unknown": (1.0, np.inf)}, "larger: expected a finite number, got inf"),
    ({"signature_cost": np.inf}, "signature_cost: expected a finite number, got inf"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: Case, message: str) -> None:
    """What it can't work with is named."""
    with pytest.raises(ValueError, match=message):
        kernels.match_object(**case(TARGET[None], **changes))


WRONG: list[tuple[Case, type[Exception], str]] = [
    ({"measured": np.ones((1, 8), np.float32)}, TypeError, "measured: expected float64"),
    ({"cut": np.zeros((1, 4))}, TypeError, "cut: expected bool"),
    ({"columns": np.ones((1, BINS))}, TypeError, "columns: expected float32"),
    ({"known": np.ones(2)}, TypeError, r"known: expected bool \(2,\)"),
    ({"known": np.ones(3, np.bool_)}, ValueError, r"known: expected bool \(2,\)"),
    ({"objects": (np.ones((1, 8)),)}, ValueError, "objects: expected a tuple of 4, got one of 1"),
    ({"unknown": 1.0}, TypeError, "costs: expected a tuple in it, got float"),
    ({"deviation": (1.0,) * 4}, ValueError, "deviation: expected a tuple of 5, got one of 4"),
    ({"max_cost": None}, TypeError, "costs: expected a number in it, got NoneType"),
]


@pytest.mark.parametrize(("changes", "error", "message"), WRONG)
def test_native_refuses_other_arrays(changes: Case, error: type[Exception], message: str) -> None:
    """Another type is named, not converted."""
    with pytest.raises(error, match=message):
        _core.match_object(**case(TARGET[None], **changes))
