# SPDX-License-Identifier: MIT
"""Votes on 200 blocks: native, reference, and a loop over the blocks."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

COUNT = 200
LIMITS, RULES = (12.0, 2.0, 15.0), (0.25, 3, 4, 8, 20)
Arrays = tuple[NDArray[Any], ...]


def arrays() -> tuple[Arrays, Arrays]:
    """Blocks in all states, and a frame's measurements in them."""
    rng = np.random.default_rng(0)
    blocks = [rng.integers(0, most, COUNT) for most in (3, 5, 9, 2, 4, 25)]
    cells = rng.choice(np.array([0, 5, 40]), COUNT)
    targets, measured, similar = ((rng.random(COUNT) ** 2 * (cells + 1)).astype(np.int64) for _ in range(3))
    blocks[3] = blocks[3].astype(np.bool_)
    return tuple(blocks), (cells, targets, measured, rng.uniform(0, 20, COUNT), similar)


def script(blocks: Arrays, seen: Arrays, limits: Any, rules: Any) -> tuple[list[Any], ...]:
    """The baseline: one block after the other, with Python's numbers."""
    (target, tolerance, occluder), (least, add, remove, release, max_idle) = limits, rules
    rows = []
    for block in zip(*(each.tolist() for each in (*blocks, *seen)), strict=True):
        state, votes, against, core, trusted, idle, cells, pixels, measured, mean, same = block
        found, close = (cells > 0 and count >= least * cells for count in (pixels, same))
        known = cells > 0 and measured >= 0.2 * cells
        hidden = known and mean > occluder and not found
        similar = known and abs(mean - target) <= tolerance
        idle = 0 if found else idle + (close and not hidden)
        core = core and idle < max_idle
        votes = votes + 1 if found or (close and core) else max(votes - (cells > 0), 0)
        if known and not (found or close or hidden) and (state == 1 or (state == 2 and not similar)):
            against += 1
        elif state == 1 and (found or close):
            against = 0
        after = state
        if state == 0 and votes >= add:
            after = 1
        elif state == 1:
            after = 0 if against >= remove or idle >= max_idle else 2 if hidden else 1
        elif state == 2:
            after = 1 if similar else 0 if against >= release else 2
        votes = 0 if after == 0 and state else min(votes, add)
        trusted = 3 if found else trusted if hidden else max(trusted - 1, 0)
        rows.append((after, votes, against if after == state else 0, core, trusted, idle))
    return tuple(map(list, zip(*rows, strict=True)))


IMPLEMENTATIONS = {"native": _core.block_votes, "reference": reference.block_votes, "baseline": script}


@pytest.mark.benchmark(group="block_votes, 200")
@pytest.mark.work(flops64=20 * 200, why="one block after the other")
@pytest.mark.parametrize("block_votes", IMPLEMENTATIONS.values(), ids=IMPLEMENTATIONS)
def bench_block_votes(benchmark: Any, block_votes: Callable[..., Any]) -> None:
    """All count the same votes."""
    arguments = (*arrays(), LIMITS, RULES)
    found = benchmark(block_votes, *arguments)
    for ours, theirs in zip(found, reference.block_votes(*arguments), strict=True):
        assert_array_equal(ours, theirs)
