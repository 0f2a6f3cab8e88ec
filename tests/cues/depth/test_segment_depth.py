# SPDX-License-Identifier: MIT
"""The objects of a depth image: one call for the stages, each of which has tests of its own."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import with_parts

Depth = NDArray[np.float32]
Floats = NDArray[np.float64]
PARTS = {
    "searched": ("region", "before", "noise", "noise_slope"),
    "ground": ("plane", "feet"),
    "divisions": ("levels", "gap", "slope", "bandwidth", "prominence", "min_area"),
}
NEAR, FAR, LEVELS = 0.3, 8.0, 256
NOTHING = np.empty((0, 0), np.float32)
NO_FLOOR = np.zeros(4)
LEVEL_FLOOR = np.array([0.0, -1.0, 0.0, 1.3])


def arguments(depth: Depth, camera: Floats, /, **changes: Any) -> dict[str, Any]:
    """What the trackers pass, with some of it changed."""
    height, width = depth.shape
    usual: dict[str, Any] = {
        "depth": depth,
        "searched": ((0, 0, width, height), NOTHING, 0.02, 0.005),
        "camera": camera,
        "ground": (NO_FLOOR, 0.35),
        "measured": (0, 0, width, height),
        "divisions": ((NEAR, FAR, LEVELS), 0.06, 0.01, 4.0, 0.05, 8),
        "cut": (2, 0.08, 0.3, 0.15),
    }
    return with_parts(usual, PARTS, changes)


def foreground(depth: Depth) -> Depth:
    """NaN where a depth is out of the range."""
    inside = (depth >= NEAR) & (depth < FAR)
    return np.where(inside, depth, np.float32(np.nan))


def assert_same(values: dict[str, Any]) -> int:
    """Native and reference agree; returns how many objects there are.

    Mean depths are sums of up to all pixels, in another order: 1e-12 of them, and of what follows from them.
    """
    native, twin = _core.segment_depth(**values), reference.segment_depth(**values)
    assert_allclose(native[0], twin[0], rtol=1e-12, atol=1e-12)
    for one, other in zip(native[1:], twin[1:], strict=True):
        assert_array_equal(one, other, strict=True)
    return len(native[0])


@given(st.integers(0, 2**32), st.booleans(), st.booleans(), st.integers(1, 40))
def test_twin_finds_the_same(seed: int, floor: bool, known: bool, min_area: int) -> None:
    """Native and reference find the same objects in any patches and region, with a floor and what was there
    before, or without.
    """
    rng = np.random.default_rng(seed)
    height, width = int(rng.integers(1, 40)), int(rng.integers(1, 150))
    depth = rng.uniform(0, 9, (height // 7 + 1, width // 7 + 1)).repeat(7, 0).repeat(7, 1)[:height, :width]
    noisy = foreground((depth + rng.normal(0, 0.02, depth.shape)).astype(np.float32))
    same = rng.random(depth.shape) < 0.3
    before = np.where(same, noisy, rng.choice(np.array([1, 4, np.nan], np.float32), depth.shape))
    x0, x1 = rng.integers(-9, width + 9, 2)
    y0, y1 = rng.integers(-9, height + 9, 2)
    corners = (min(x0, x1), min(y0, y1), max(x0, x1), max(y0, y1))
    usual = (0, 0, width, height)
    assert_same(
        arguments(
            noisy,
            np.array([90.0, 91, 40, 20]),
            before=before if known else NOTHING,
            region=tuple(map(int, corners)) if seed % 2 else usual,
            plane=LEVEL_FLOOR if floor else NO_FLOOR,
            min_area=min_area,
        )
    )


@pytest.mark.parametrize("size", range(5, 41))
def test_centroid_of_a_symmetric_object(kernels: Kernels, size: int) -> None:
    """Its centroid is the center of its box, however its pixels and the bins of the shares meet."""
    half = (size - 1) / 2
    beside, below = np.mgrid[-half : half + 1, -half : half + 1]
    depth = np.full((48, 48), np.nan, np.float32)
    depth[3 : size + 3, 4 : size + 4][np.hypot(beside, below) <= half + 0.1] = 2
    found = kernels.segment_depth(**arguments(depth, np.array([90.0, 91, 40, 20])))
    assert len(found[0]) == 1
    assert_allclose(found[0][0, 5:7], 0, rtol=0, atol=1e-7)


def test_twin_finds_the_same_in_pictures(picture: Depth, camera: Floats) -> None:
    """They also agree on pictures of awkward sizes and layouts."""
    assert_same(arguments(foreground(picture), camera))


def test_twin_finds_the_same_in_a_room(noisy_room: Depth, camera: Floats, floor: Floats) -> None:
    """They also agree on a room with a tilted floor, which has several objects."""
    assert assert_same(arguments(foreground(noisy_room), camera, plane=floor)) > 1


def test_twin_finds_the_same_beyond_the_range() -> None:
    """Depths out of the range belong to nothing, also where they touch what is in it."""
    depth = np.random.default_rng(0).uniform(1, 12, (40, 150)).astype(np.float32)
    depth[10:20, 30:90] = 4.0
    smooth = {"gap": 1e6, "slope": 0.0, "min_area": 2, "plane": NO_FLOOR}
    assert assert_same(arguments(depth, LENS, **smooth)) > 1


def drawn(*boxes: tuple[tuple[int, int, int, int], float]) -> Depth:
    """Flat boxes x, y, width, height at their depths, before nothing."""
    depth = np.full((120, 160), np.nan, np.float32)
    for (x, y, width, height), z in boxes:
        depth[y : y + height, x : x + width] = z
    return depth


LENS = np.array([140.0, 140, 79.5, 59.5])
TWO = [((20, 30, 30, 60), 2.0), ((90, 50, 40, 30), 4.0)]


def test_agrees_with_opencv(kernels: Kernels) -> None:
    """Boxes at two depths are the components that OpenCV finds in each, at their places in meters."""
    depth = drawn(*TWO)
    measured, cut, columns, rows = kernels.segment_depth(**arguments(depth, LENS))
    assert len(measured) == 2
    assert not cut.any()
    for found, z in zip(measured, (2.0, 4.0), strict=True):
        _, _, stats, _ = cv2.connectedComponentsWithStats((depth == z).astype(np.uint8))
        x, y, width, height, area = stats[1]
        assert_allclose(found[3:5], [width * z / 140, height * z / 140], rtol=1e-12)
        assert_allclose(found[:2], [(x + width / 2 - 80) * z / 140, (y + height / 2 - 60) * z / 140])
        assert_allclose([found[2], found[7]], [z, area * (z / 140) ** 2], rtol=1e-12)
    assert_allclose([columns.sum(axis=1), rows.sum(axis=1)], 1, rtol=1e-6)


def test_an_edge_separates(kernels: Kernels) -> None:
    """In one division a box in front of a larger one is an object of its own, with a ring of edges around it
    that belong to neither; without edges both are one.
    """
    depth = drawn(((20, 20, 80, 80), 3.0), ((40, 40, 20, 30), 2.7))
    one_division = {"bandwidth": 128.0, "prominence": 1.0}
    separate = kernels.segment_depth(**arguments(depth, LENS, **one_division))[0]
    together = kernels.segment_depth(**arguments(depth, LENS, **one_division, gap=1e6, slope=0.0))[0]
    assert (len(separate), len(together)) == (2, 1)
    ring = 22 * 32 - 20 * 30
    assert_allclose(separate[0, 7], (80 * 80 - 20 * 30 - ring) * (3.0 / 140) ** 2, rtol=1e-12)


def test_nothing_is_found_where_it_is_not_looked_for(kernels: Kernels) -> None:
    """A region takes an object away, or a part of it."""
    measured, *_ = kernels.segment_depth(**arguments(drawn(*TWO), LENS, region=(-5, 40, 85, 500)))
    assert len(measured) == 1
    assert_allclose(measured[0, 4], 50 * 2.0 / 140, rtol=1e-12)


def test_what_was_there_before_is_left_out(kernels: Kernels) -> None:
    """Of two boxes the one that was there before, but for noise, is no object; where nothing was measured
    before, all is searched.
    """
    before = drawn(TWO[1]) + np.float32(0.03)
    measured, *_ = kernels.segment_depth(**arguments(drawn(*TWO), LENS, before=before))
    assert_allclose(measured[:, 2], [2.0], rtol=1e-12)
    strict = arguments(drawn(*TWO), LENS, before=before, noise=0.02, noise_slope=0.0)
    assert len(kernels.segment_depth(**strict)[0]) == 2


@pytest.mark.parametrize("side", range(4))
def test_the_edge_of_what_was_measured_cuts(kernels: Kernels, side: int) -> None:
    """An object less than the border from it is cut there and nowhere else, one as far from it isn't."""
    (x, y, width, height), _ = TWO[0]
    for gap in (1, 2):
        edges = [0, 0, 160, 120]
        edges[[0, 2, 1, 3][side]] = [x - gap, x + width + gap, y - gap, y + height + gap][side]
        cut = kernels.segment_depth(**arguments(drawn(TWO[0]), LENS, measured=tuple(edges)))[1]
        assert_array_equal(cut, [[gap == 1 and each == side for each in range(4)]])


def test_many_divisions(kernels: Kernels) -> None:
    """Of more minima than labels the first 254 divide; the last division has all that is farther."""
    z = np.linspace(0.5, 300, 300)
    depth = np.full((3, 1200), np.nan, np.float32)
    depth[:, ::4] = z
    fine = {"levels": (0.1, 310.0, 4096), "bandwidth": 1.0, "prominence": 0.0, "min_area": 3}
    measured, *_ = kernels.segment_depth(**arguments(depth, LENS, **fine, plane=NO_FLOOR))
    assert_allclose(np.sort(measured[:, 2]), z, rtol=1e-6)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"before": np.ones((2, 3), np.float32)}, r"before: expected shape \(120, 160\), got \(2, 3\)"),
        ({"before": drawn(*TWO), "noise": -1.0}, "noise: expected a finite number, not negative, got -1"),
        ({"noise_slope": np.nan}, "slope: expected a finite number, not negative, got nan"),
        ({"camera": np.ones(3)}, r"camera: expected shape \(4,\), got \(3,\)"),
        ({"plane": np.ones(3)}, "up: expected a vector of length 1"),
        ({"plane": np.ones(4), "region": (9, 0, 9, 9)}, "up: expected a vector of length 1"),
        ({"plane": np.zeros(3)}, r"plane: expected shape \(4,\), got \(3,\)"),
        ({"levels": (2.0, 1.0, 9)}, "far: expected a finite number above near, got 1"),
        ({"gap": -1.0}, "gap: expected a finite number, not negative, got -1"),
        ({"bandwidth": 0.0, "prominence": 0.0}, r"bandwidth: expected a number in \(0, 256\], got 0"),
        ({"bandwidth": 1.0, "prominence": -1.0}, "prominence: expected a number of at least 0, got -"),
        ({"min_area": 0}, "min_area: expected at least 1, got 0"),
        ({"cut": (2, 0.1, 0.1, 2.0)}, r"share: expected a number in \[0, 1\], got 2"),
        ({"feet": -1.0}, "feet: expected a finite number, not negative, got -1"),
    ],
)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Each stage names what it can't work with."""
    with pytest.raises(ValueError, match=message):
        kernels.segment_depth(**arguments(drawn(*TWO), LENS, **changes))


BAD: list[tuple[dict[str, Any], str]] = [
    ({"depth": np.ones((120, 160))}, r"depth: expected a float32 depth image \(H, W\), got float64"),
    ({"before": np.ones((120, 160))}, r"before: expected a float32 depth image \(H, W\), got float64"),
    ({"camera": LENS.astype(np.float32)}, "camera: expected float64"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_native_refuses_other_arrays(changes: dict[str, Any], message: str) -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match=message):
        _core.segment_depth(**arguments(drawn(*TWO), LENS, **changes))
