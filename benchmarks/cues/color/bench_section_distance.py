# SPDX-License-Identifier: MIT
"""Distance of the rank sections of 100 ellipses: native, reference, and one line of NumPy."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from tricue import _core, reference

Image = NDArray[np.uint8]


def script(sections: NDArray[np.float32], model: NDArray[np.float32]) -> NDArray[np.float32]:
    """The baseline: norms of the channels, in float32."""
    result: NDArray[np.float32] = np.linalg.norm(sections - model, axis=2).sum(axis=1) / np.float32(
        3 * np.sqrt(2)
    )
    return result


@pytest.mark.benchmark(group="section_distance")
@pytest.mark.work(flops64=3 * 300 * 16, why="sums in one order")
@pytest.mark.parametrize(
    "section_distance",
    [_core.section_distance, reference.section_distance, script],
    ids=["native", "reference", "baseline"],
)
def bench_section_distance(benchmark: Any, section_distance: Callable[..., Any], samples: Image) -> None:
    """All measure the same, within float32's rounding in the baseline."""
    sections = reference.rank_sections(samples, 16)
    distances = benchmark(section_distance, sections, sections[0])
    assert_allclose(distances, reference.section_distance(sections, sections[0]), rtol=0, atol=1e-6)
