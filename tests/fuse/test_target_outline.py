# SPDX-License-Identifier: MIT
"""The rectangle around what is the target's in its blocks."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tricue import _core, reference
from tricue.kernels import Kernels

H, W = 30, 50
BLOCKS = np.array([[0.0, 0, 10, 10], [10, 0, 20, 10], [0, 10, 10, 20], [10, 10, 20, 20]])


def case(seed: int | None = None, **changes: Any) -> dict[str, Any]:
    """Four blocks at (15, 5), all the target's, without any target pixel or disparity; or some of each."""
    arguments: dict[str, Any] = {
        "mask": np.zeros((H, W), np.uint8),
        "disparity": np.full((H, W), np.nan, np.float32),
        "grid": (BLOCKS, (1.0, 115.0, 55.0, 100.0, 50.0)),
        "states": np.ones(4, np.int64),
        "target": 8.0,
        "tolerance": 0.5,
    }
    if seed is not None:
        rng = np.random.default_rng(seed)
        arguments["mask"] = (rng.random((H, W)) < 0.1).astype(np.uint8)
        arguments["disparity"] = rng.uniform(4, 12, (H, W)).astype(np.float32)
        arguments["states"] = rng.integers(0, 3, 4)
    return {**arguments, **changes}


@given(st.integers(0, 2**32), st.floats(0.1, 3), st.floats(-40, 40))
def test_twin_gives_the_same(seed: int, size: float, shift: float) -> None:
    """Native and reference agree on any mask and grid: they compare and count."""
    arguments = case(seed, grid=(BLOCKS, (size, 115 + shift, 55 - shift, 100.0, 50.0)))
    assert _core.target_outline(**arguments) == reference.target_outline(**arguments)


@pytest.mark.parametrize("by", ["mask", "disparity"])
def test_boxes_what_was_drawn(by: str, kernels: Kernels) -> None:
    """A rectangle of target pixels, or of their disparity, is found, as far as it is in target blocks. Of
    12 x 8 pixels one is left out at each side, less than a column or a row.
    """
    arguments = case()
    arguments[by][8:16, 20:32] = 8
    assert kernels.target_outline(**arguments) == ((20, 8, 32, 16), 96)
    arguments[by][20:28, :8] = 8
    assert kernels.target_outline(**arguments) == ((20, 8, 32, 16), 96)
    assert kernels.target_outline(**{**arguments, "states": np.array([1, 2, 1, 0])}) == ((20, 8, 25, 16), 40)
    assert kernels.target_outline(**{**arguments, "states": np.zeros(4, np.int64)}) == ((0, 0, 0, 0), 0)


def test_another_disparity_is_not_the_targets(kernels: Kernels) -> None:
    """What differs by more than the tolerance doesn't count, nor does what has no disparity."""
    for disparity, count in ((8.5, 400), (8.51, 0), (7.49, 0), (7.5, 400), (np.nan, 0), (np.inf, 0)):
        assert kernels.target_outline(**case(disparity=np.full((H, W), disparity, np.float32)))[1] == count


BAD: list[tuple[dict[str, Any], str]] = [
    ({"mask": np.zeros((H, W + 1), np.uint8)}, rf"mask: expected shape \({H}, {W}\), got \({H}, {W + 1}\)"),
    ({"states": np.zeros(5, np.int64)}, "states: expected 4 numbers, got 5"),
    ({"grid": (BLOCKS, (1.0, 0.0, np.nan, 0.0, 0.0))}, "corners: expected finite numbers"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Unlike shapes and sizes, and corners that aren't finite, are named."""
    with pytest.raises(ValueError, match=message):
        kernels.target_outline(**case(**changes))
