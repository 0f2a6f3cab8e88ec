# SPDX-License-Identifier: MIT
"""Histograms of depth under a mask."""

from typing import Any

import numpy as np
import pytest
import scipy.stats
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Depth = NDArray[np.float32]
Mask = NDArray[np.uint8]
NEAR, FAR, LEVELS = 0.3, 7.5, 256
ONE, SEEN = np.ones((1, 1), np.float32), np.ones((1, 1), np.uint8)

shapes = st.tuples(st.integers(0, 3), st.integers(0, 70))
limits = st.tuples(st.floats(-1, 8), st.floats(-1, 8)).filter(lambda pair: pair[0] != pair[1]).map(sorted)


def everything(depth: Depth) -> Mask:
    """A mask that leaves nothing out."""
    return np.full(depth.shape, 255, np.uint8)


@given(
    shapes.flatmap(lambda s: st.tuples(arrays(np.float32, s), arrays(np.uint8, s))),
    limits,
    st.integers(1, 300) | st.just(65536),
)
def test_twin_counts_the_same(images: tuple[Depth, Mask], limits: tuple[float, float], levels: int) -> None:
    """Native and reference count the same, exactly, for any depth, mask and levels."""
    native = _core.depth_histogram(*images, *limits, levels)
    assert_array_equal(native, reference.depth_histogram(*images, *limits, levels), strict=True)


def test_twin_counts_pictures_the_same(picture: Depth) -> None:
    """They also agree on pictures of awkward sizes and layouts."""
    arguments = picture, everything(picture), NEAR, FAR, LEVELS
    assert_array_equal(_core.depth_histogram(*arguments), reference.depth_histogram(*arguments), strict=True)


@pytest.mark.parametrize("levels", [1, 2, 64, 65536])
def test_agrees_with_scipy(kernels: Kernels, picture: Depth, levels: int) -> None:
    """With limits and widths that binary numbers hold exactly SciPy counts the same, of any picture."""
    mask = np.random.default_rng(0).integers(0, 2, picture.shape, np.uint8)
    counted = picture[(mask > 0) & (picture >= 0.5) & (picture < 8.5)]  # SciPy's last level holds its end too
    expected = scipy.stats.binned_statistic(counted, None, "count", levels, (0.5, 8.5)).statistic
    assert_array_equal(kernels.depth_histogram(picture, mask, 0.5, 8.5, levels), expected)


def test_agrees_with_numpy(kernels: Kernels, noisy_room: Depth) -> None:
    """numpy.histogram counts the same of a noisy room, but for a few pixels whose level rounding decides."""
    valid = noisy_room[noisy_room > 0].astype(np.float64)
    expected, _ = np.histogram(valid, LEVELS, (NEAR, FAR))
    counts = kernels.depth_histogram(noisy_room, everything(noisy_room), NEAR, FAR, LEVELS)
    assert counts.sum() == valid.size  # nothing of the room lies outside
    assert abs(counts - expected).sum() <= 4


def test_room(kernels: Kernels, room: Depth, surfaces: NDArray[np.float64]) -> None:
    """Under a mask of the person all that counts lies within the few levels round 2.5 m."""
    person = (surfaces.argmin(axis=0) == 2).astype(np.uint8)
    counts = kernels.depth_histogram(room, person, 0.0, 8.0, 80)
    assert counts.sum() == person.sum()
    assert counts[20:30].sum() == person.sum()


def test_limits(kernels: Kernels) -> None:
    """Levels hold their lower limits; near counts, far doesn't."""
    depth = np.array([[0.99, 1, 1.49, 1.5, 2.99, 3, 7]], np.float32)
    assert_array_equal(kernels.depth_histogram(depth, everything(depth), 1.0, 3.0, 4), [2, 1, 0, 1])


def test_top_level_takes_what_rounding_puts_above(kernels: Kernels) -> None:
    """The last float below far is in the last level, however its place is rounded."""
    for far in np.random.default_rng(0).uniform(1, 9, 200):
        below = np.nextafter(np.float32(far), np.float32(0))
        depth = np.array([[below]])
        counts = kernels.depth_histogram(depth, SEEN, 0.0, np.nextafter(np.float64(below), 10.0), 65536)
        assert counts[-1] == 1 == counts.sum()


def test_narrowest_range(kernels: Kernels) -> None:
    """Limits so near to each other that there are infinite levels a meter still count what lies between."""
    tiny = np.nextafter(0.0, 1.0)
    depth = np.array([[1e-45, 1, np.nan]], np.float32)
    assert kernels.depth_histogram(depth, everything(depth), 0.0, tiny, 3).sum() == 0
    assert kernels.depth_histogram(depth, everything(depth), 1.0, np.nextafter(1.0, 2.0), 3).sum() == 1


def test_mask_and_holes(kernels: Kernels, noisy_room: Depth) -> None:
    """Masks that part the picture part the counts; holes count nowhere, whatever the range."""
    mask = np.random.default_rng(0).choice(np.array([0, 1, 255], np.uint8), noisy_room.shape)
    rest = (mask == 0).astype(np.uint8)
    whole, inside, outside = (
        kernels.depth_histogram(noisy_room, part, NEAR, FAR, LEVELS)
        for part in (everything(noisy_room), mask, rest)
    )
    assert_array_equal(inside + outside, whole)
    assert inside.any()
    assert outside.any()
    holes = np.array([[np.nan, 0, -0.0, -1, np.inf, -np.inf]], np.float32)
    assert not kernels.depth_histogram(holes, everything(holes), -1e300, 1e300, 2).any()


@pytest.mark.parametrize(
    ("near", "far", "levels", "message"),
    [
        (np.nan, 1.0, 4, "near: expected a finite number, got nan"),
        (-np.inf, 1.0, 4, "near: expected a finite number, got -inf"),
        (0.0, np.inf, 4, "far: expected a finite number above near, got inf"),
        (0.0, np.nan, 4, "far: expected a finite number above near, got nan"),
        (2.0, 2.0, 4, "far: expected a finite number above near, got 2"),
        (0.0, 1.0, 0, "levels: expected 1 to 65536, got 0"),
        (0.0, 1.0, 65537, "levels: expected 1 to 65536, got 65537"),
    ],
)
def test_refuses_other_levels(kernels: Kernels, near: float, far: float, levels: int, message: str) -> None:
    """A range or a number of levels that is none is named."""
    with pytest.raises(ValueError, match=message):
        kernels.depth_histogram(ONE, SEEN, near, far, levels)


def test_refuses_other_masks(kernels: Kernels) -> None:
    """A mask of another shape is named."""
    with pytest.raises(ValueError, match=r"mask: expected shape \(1, 1\), got \(1, 2\)"):
        kernels.depth_histogram(ONE, np.ones((1, 2), np.uint8), NEAR, FAR, LEVELS)


BAD: list[tuple[Any, Any, str]] = [
    (np.ones((1, 1)), SEEN, "depth: expected a float32 depth image"),
    (ONE, np.ones((1, 1), np.bool_), "mask: expected a uint8 mask"),
    (ONE, None, "mask: expected a NumPy array, a uint8 mask"),
]


@pytest.mark.parametrize(("depth", "mask", "message"), BAD)
def test_native_refuses_other_types(depth: Any, mask: Any, message: str) -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match=message):
        _core.depth_histogram(depth, mask, NEAR, FAR, LEVELS)
