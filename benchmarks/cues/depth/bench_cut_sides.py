# SPDX-License-Identifier: MIT
"""The cut sides of eight objects of a depth image of 176x144: native, reference, and a script on OpenCV."""

from collections.abc import Callable
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
CUT = (2, 0.08, 0.3, 0.15)  # border, beside, occluder margin, share
# x, y, width, height, area, depth, label: the person in the room, and objects behind, before and beside.
TABLE = np.array(
    [
        [71.0, 16, 39, 100, 3500, 2.5, 1],
        [110, 20, 40, 60, 2000, 4.0, 2],
        [30, 30, 41, 50, 1500, 3.5, 2],
        [0, 10, 30, 90, 2000, 3.0, 1],
        [140, 60, 36, 84, 2500, 2.0, 1],
        [60, 0, 60, 16, 800, 4.8, 3],
        [20, 100, 50, 44, 1800, 1.2, 1],
        [100, 90, 20, 20, 300, 3.2, 2],
    ]
)


def script(
    depth: Depth,
    table: Floats,
    camera: Floats,
    cut: tuple[int, float, float, float],
) -> NDArray[np.bool_]:
    """The baseline: one remap of all places, which rounds where we take the floor, and a mean per side."""
    border, beside, occluder_margin, share = cut
    height, width = depth.shape
    x, y, w, h, z = table[:, [0, 1, 2, 3, 5]].T
    along = (2 * np.arange(12) + 1) / 12 - 1
    u = np.stack([-np.ones(12), np.ones(12), along, along])
    v = np.stack([along, along, -np.ones(12), np.ones(12)])
    half_width, half_height = w / 2 + beside * camera[0] / z, h / 2 + beside * camera[1] / z
    across = (x + w / 2 - 0.5)[:, None, None] + half_width[:, None, None] * u
    down = (y + h / 2 - 0.5)[:, None, None] + half_height[:, None, None] * v
    places = np.stack([across, down], axis=-1).reshape(-1, 12, 2).astype(np.float32)
    seen = cv2.remap(depth, places, None, cv2.INTER_NEAREST, borderValue=np.nan).reshape(-1, 4, 12)
    behind = (seen < (z - occluder_margin)[:, None, None]).mean(axis=2) > share
    at_border = np.stack([x < border, x + w > width - border, y < border, y + h > height - border], axis=1)
    return behind | at_border


@pytest.mark.benchmark(group="cut_sides")
@pytest.mark.work(lookups=8 * 4 * 12, why="the call, and places one by one")
@pytest.mark.parametrize(
    "cut_sides", [_core.cut_sides, reference.cut_sides, script], ids=["native", "reference", "baseline"]
)
def bench_cut_sides(benchmark: Any, cut_sides: Callable[..., Any], room: Depth, camera: Floats) -> None:
    """All find the same cut sides; each of the four sides is among them."""
    arguments = room, TABLE, camera, CUT
    cut = benchmark(cut_sides, *arguments)
    assert_array_equal(cut, reference.cut_sides(*arguments))
    assert cut.any(axis=0).all()
    assert not cut.all(axis=0).any()
