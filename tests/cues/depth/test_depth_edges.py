# SPDX-License-Identifier: MIT
"""Jumps of depth."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]
GAP, SLOPE = 0.1, 0.02
HOLES = [np.nan, 0, -0.0, -1, np.inf, -np.inf]

shapes = st.tuples(st.integers(0, 4), st.integers(0, 70))
levels = st.sampled_from(
    np.array([1.0, 1.1, 1.125, 1.25, 2.0, *HOLES], np.float32).tolist()
)  # few, so that thresholds are met exactly
steps = st.sampled_from([0.0, 0.1, 0.125, 1e30]) | st.floats(0, 1)


def by_hand(depth: Depth, gap: float, slope: float) -> NDArray[np.uint8]:
    """Pair by pair, in exact arithmetic but for float32 depths."""
    edges = np.zeros(depth.shape, np.uint8)
    for here in np.ndindex(depth.shape):
        for there in np.ndindex(depth.shape):
            far, near = float(depth[here]), float(depth[there])
            adjacent = max(abs(here[0] - there[0]), abs(here[1] - there[1])) == 1
            if adjacent and 0 < near < np.inf and 0 < far < np.inf:
                edges[here] |= far - near > gap + slope * near**2
    return edges


@given(arrays(np.float32, shapes) | arrays(np.float32, shapes, elements=levels), steps, steps)
def test_twin_finds_the_same(depth: Depth, gap: float, slope: float) -> None:
    """Native and reference find the same edges in any depth: both compute in float32, in one order."""
    native = _core.depth_edges(depth, gap, slope)
    assert_array_equal(native, reference.depth_edges(depth, gap, slope), strict=True)


@pytest.mark.parametrize("slope", [0.0, SLOPE])
def test_twin_finds_the_same_in_pictures(picture: Depth, slope: float) -> None:
    """They also agree on pictures of awkward sizes and layouts."""
    native = _core.depth_edges(picture, GAP, slope)
    assert_array_equal(native, reference.depth_edges(picture, GAP, slope), strict=True)


def test_agrees_with_every_pair(kernels: Kernels) -> None:
    """A loop over all pairs of pixels, in float64, finds the same edges in noise with holes."""
    rng = np.random.default_rng(3)
    depth = rng.uniform(1, 2, (13, 17)).astype(np.float32)
    depth[rng.random(depth.shape) < 0.3] = np.nan
    for gap, slope in ((0.7, 0.0), (0.2, 0.2), (0.0, 0.5), (0.0, 0.0)):
        expected = by_hand(depth, gap, slope)
        assert 0 < expected.sum() < np.isfinite(depth).sum()
        assert_array_equal(kernels.depth_edges(depth, gap, slope), expected)


def test_agrees_with_opencv(kernels: Kernels, noisy_room: Depth) -> None:
    """Without slope an edge is what exceeds OpenCV's erosion, the least of 3x3, by the gap."""
    filled = np.where(np.isnan(noisy_room), np.float32(1e9), noisy_room)
    nearest = cv2.erode(filled, np.ones((3, 3), np.uint8))
    expected = (noisy_room - nearest > np.float32(GAP)).astype(np.uint8)
    assert 1000 < expected.sum() < expected.size
    assert_array_equal(kernels.depth_edges(noisy_room, GAP, 0.0), expected)


def test_room(kernels: Kernels, room: Depth, surfaces: NDArray[np.float64]) -> None:
    """All that borders on the person and is well behind him is an edge; no surface has one in itself."""
    edges = kernels.depth_edges(room, GAP, SLOPE)
    nearest = surfaces.argmin(axis=0)
    person = (nearest == 2).astype(np.uint8)
    rim = cv2.dilate(person, np.ones((3, 3), np.uint8)) - person
    behind = room > 3.2
    assert edges[(rim == 1) & behind].all()
    assert not edges[rim == 0].any()


def test_farther_pixel_has_the_edge(kernels: Kernels) -> None:
    """A nearer pixel makes edges of its eight neighbors and is none itself; past a hole nothing is seen."""
    depth = np.full((5, 7), 3, np.float32)
    depth[2, 2] = 1
    expected = np.zeros((5, 7), np.uint8)
    expected[1:4, 1:4] = 1
    expected[2, 2] = 0
    assert_array_equal(kernels.depth_edges(depth, 1.0, 0.5), expected)
    assert not kernels.depth_edges(depth, 1.5, 0.5).any()  # the difference of 2 isn't more than 1.5 + 0.5
    assert not kernels.depth_edges(np.float32([[1, np.nan, 3]]), 0.5, 0.0).any()


@pytest.mark.parametrize("hole", HOLES)
def test_holes_are_no_edges(kernels: Kernels, hole: float) -> None:
    """What wasn't measured is no edge and makes none, even where every difference is one."""
    depth = np.full((6, 70), 2, np.float32)
    depth[::2, ::3] = hole
    assert not kernels.depth_edges(depth, 0.0, 0.0).any()


@given(arrays(np.float32, shapes, elements=st.floats(0.25, 8, width=32)))
def test_turned_pictures_have_turned_edges(depth: Depth) -> None:
    """No direction is preferred: edges of the turned picture are the edges turned."""
    edges = _core.depth_edges(depth, GAP, SLOPE)
    turned = _core.depth_edges(np.ascontiguousarray(np.rot90(depth)), GAP, SLOPE)
    assert_array_equal(turned, np.rot90(edges))


@pytest.mark.parametrize(
    ("gap", "slope", "message"),
    [
        (-0.1, 0.0, "gap: expected a finite number, not negative, got -0.1"),
        (np.nan, 0.0, "gap: expected a finite number, not negative, got nan"),
        (0.0, -1.0, "slope: expected a finite number, not negative, got -1"),
        (0.0, np.inf, "slope: expected a finite number, not negative, got inf"),
    ],
)
def test_refuses_other_steps(kernels: Kernels, gap: float, slope: float, message: str) -> None:
    """A gap or slope that is negative or not finite is named."""
    with pytest.raises(ValueError, match=message):
        kernels.depth_edges(np.ones((2, 2), np.float32), gap, slope)


def test_native_refuses_other_types() -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match="depth: expected a float32 depth image"):
        _core.depth_edges(np.ones((2, 2)), GAP, SLOPE)  # type: ignore[arg-type]
