# SPDX-License-Identifier: MIT
"""Connected regions of a divided depth image, and their signatures."""

from typing import Any

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

Labels = NDArray[np.uint8]
Depth = NDArray[np.float32]
EPS = float(np.finfo(np.float64).eps)
NEAR, FAR, LEVELS, BINS = 0.3, 7.5, 16, 5

# Few labels make large regions, and runs of two labels that end in the same column.
labeled = arrays(np.uint8, st.tuples(st.integers(0, 12), st.integers(0, 20)), elements=st.integers(0, 3))


def depths(shape: tuple[int, ...], seed: int) -> Depth:
    """Depths in and beyond [NEAR, FAR), on levels' edges too, and every kind of pixel without one."""
    rng = np.random.default_rng(seed)
    edges = NEAR + rng.integers(0, LEVELS + 1, shape) * (FAR - NEAR) / LEVELS
    depth = np.where(rng.random(shape) < 0.3, edges, rng.uniform(0.01, 10, shape)).astype(np.float32)
    missing = rng.random(shape) < 0.2
    depth[missing] = rng.choice(np.array([np.nan, 0, -1, np.inf, -np.inf], np.float32), shape)[missing]
    return depth


def draw(*rows: str) -> Labels:
    """A digit is a label, a dot none."""
    return np.array([[0 if each == "." else int(each) for each in row] for row in rows], np.uint8)


def describe(kernels: Kernels, labels: Labels, depth: Depth, min_area: int = 1) -> Any:
    """All that is said of the regions, with the parameters that most tests have in common."""
    return kernels.depth_components(labels, depth, NEAR, FAR, LEVELS, BINS, min_area, True)


def assert_same(native: Any, twin: Any) -> None:
    """Counts, and shares that are rounded twice alike, to the last bit; means to the order of sums of as many
    positive numbers as the image has pixels.
    """
    for ours, theirs in zip(native, twin, strict=True):
        assert ours.dtype == theirs.dtype
        assert ours.shape == theirs.shape
    mean = 5
    rounding = native[4].size * EPS
    assert_allclose(native[0][:, mean], twin[0][:, mean], rtol=rounding)
    assert_array_equal(np.delete(native[0], mean, 1), np.delete(twin[0], mean, 1))
    for ours, theirs in zip(native[1:], twin[1:], strict=True):
        assert_array_equal(ours, theirs)


@given(labeled, st.integers(0, 2**32), st.integers(1, 6))
def test_twin_finds_the_same(labels: Labels, seed: int, min_area: int) -> None:
    """Native and reference describe the same regions in the same order, in noise of every shape."""
    depth = depths(labels.shape, seed)
    assert_same(*(describe(k, labels, depth, min_area) for k in (_core, reference)))


@given(st.integers(0, 2**32), st.integers(0, 300), st.integers(1, 40), st.floats(0, 5), st.floats(0.01, 9))
def test_twin_counts_the_same(seed: int, levels: int, bins: int, near: float, length: float) -> None:
    """They agree for any range, number of levels and of bins, more bins than pixels included."""
    rng = np.random.default_rng(seed)
    labels = rng.integers(0, 3, (9, 11)).astype(np.uint8).repeat(3, axis=0).repeat(4, axis=1)
    parameters = (near, near + length, levels, bins, 3, True)
    depth = depths(labels.shape, seed)
    assert_same(*(k.depth_components(labels, depth, *parameters) for k in (_core, reference)))


@pytest.mark.parametrize("cols", [1, 7, 8, 9, 16, 63, 64, 65, 200])
def test_twin_finds_the_same_in_rows_of_any_length(cols: int) -> None:
    """They agree on rows shorter than a word or a vector, as long, and longer, cut from wider depth."""
    rng = np.random.default_rng(cols)
    for density in (0.1, 0.9):
        labels = (rng.random((20, cols)) < density).astype(np.uint8) * rng.integers(1, 3, (20, 1), np.uint8)
        depth = depths((25, cols + 7), cols)[2:22, 3 : cols + 3]
        assert_same(*(describe(k, labels, depth) for k in (_core, reference)))


@pytest.mark.parametrize("density", [0.05, 0.4, 0.6, 0.95])
def test_agrees_with_opencv(kernels: Kernels, density: float) -> None:
    """OpenCV finds the same regions of each label, in noise below, at and above percolation."""
    rng = np.random.default_rng(1)
    labels = np.where(rng.random((50, 60)) < density, rng.integers(1, 4, (50, 60)), 0).astype(np.uint8)
    table, _, _, _, components = describe(kernels, labels, depths(labels.shape, 0))
    for label in (1, 2, 3):
        count, image, stats, _ = cv2.connectedComponentsWithStats((labels == label).view(np.uint8))
        ours = np.flatnonzero(table[:, 6] == label)
        assert len(ours) == count - 1
        for i in ours:
            inside = components == i + 1
            (theirs,) = np.unique(image[inside])
            assert_array_equal(inside, image == theirs)
            assert_array_equal(table[i, :5], stats[theirs])


@pytest.mark.parametrize("levels", [1, 16, 100])
def test_agrees_with_numpy(kernels: Kernels, levels: int) -> None:
    """A region's histogram is NumPy's of its depths, clamped to the range; its mean is NumPy's."""
    rng = np.random.default_rng(3)
    labels = rng.integers(0, 2, (6, 8)).astype(np.uint8).repeat(5, axis=0).repeat(5, axis=1)
    depth = rng.uniform(0, 9, labels.shape).astype(np.float32)
    found = kernels.depth_components(labels, depth, NEAR, FAR, levels, BINS, 1, True)
    for i, (row, histogram) in enumerate(zip(found[0], found[1], strict=True)):
        z = depth[found[4] == i + 1].astype(float)
        counts, _ = np.histogram(z.clip(NEAR, FAR), levels, (NEAR, FAR))
        assert_allclose(histogram, counts / len(z), rtol=1e-7)
        assert_allclose(row[5], z.mean(), rtol=1e-12)


def test_example_by_hand(kernels: Kernels) -> None:
    """Diagonal neighbors are one region, another label is another; a hole counts for area and box only."""
    labels = draw(
        "1.122",
        "1.122",
        ".1...",
        "....3"
    )  # fmt: skip
    depth = np.full(labels.shape, 2.0, np.float32)
    depth[0, 0] = np.nan
    depth[2, 1] = 3.0
    depth[3, 4] = -np.inf
    table, histograms, columns, rows, components = kernels.depth_components(
        labels, depth, 1, 5, 4, 3, 1, True
    )
    assert_array_equal(table, [[0, 0, 3, 3, 5, 2.25, 1], [3, 0, 2, 2, 4, 2, 2], [4, 3, 1, 1, 1, np.nan, 3]])
    assert_array_equal(histograms, [[0, 0.75, 0.25, 0], [0, 1, 0, 0], [0, 0, 0, 0]])
    fifths = np.array([2, 1, 2], np.float32) / np.float32(5)
    thirds = np.ones(3, np.float32) / np.float32(3)  # of one or two pixels in three bins, too
    assert_array_equal(columns, [fifths, thirds, thirds])
    assert_array_equal(rows, [fifths[[0, 2, 1]], thirds, thirds])
    assert_array_equal(components, draw("1.122", "1.122", ".1...", "....3"))


def test_labels_that_end_together(kernels: Kernels) -> None:
    """Where two labels end in one column above and below, regions touch across the corner, both ways."""
    labels = draw("1122", "2211")
    table = describe(kernels, labels, depths(labels.shape, 0))[0]
    assert_array_equal(table[:, [0, 1, 2, 3, 4, 6]], [[0, 0, 4, 2, 4, 1], [0, 0, 4, 2, 4, 2]])


def test_spiral(kernels: Kernels) -> None:
    """A spiral, whose runs are joined late and again and again, is one region, and so is what is between."""
    labels = draw(
        "111111111",
        "222222221",
        "111111121",
        "122222121",
        "121112121",
        "121222121",
        "121111121",
        "122222221",
        "111111111"
    )  # fmt: skip
    table = describe(kernels, labels, depths(labels.shape, 0))[0]
    assert_array_equal(table[:, 6], [1, 2])
    assert_array_equal(table[:, 4], [np.count_nonzero(labels == 1), np.count_nonzero(labels == 2)])


def test_order_and_size(kernels: Kernels) -> None:
    """Larger first; of equals the one whose first pixel comes first in reading order."""
    labels = draw("..1..22", ".1.....", "1..3.1.", ".......", "3.3....")
    found = describe(kernels, labels, depths(labels.shape, 0))
    assert_array_equal(found[0][:, 4], [3, 2, 1, 1, 1, 1])
    assert_array_equal(found[0][:, 0], [0, 5, 3, 5, 0, 2])
    larger = describe(kernels, labels, depths(labels.shape, 0), min_area=2)
    assert_array_equal(larger[0], found[0][:2])
    assert_array_equal(larger[4], np.where(found[4] <= 2, found[4], 0))


@given(labeled, st.integers(0, 2**32))
def test_every_pixel_in_one_region(labels: Labels, seed: int) -> None:
    """The image of components has the areas of the table, its labels, and nothing where there is no label."""
    table, histograms, columns, rows, components = describe(_core, labels, depths(labels.shape, seed))
    assert_array_equal(components > 0, labels > 0)
    counts = np.bincount(components.ravel(), minlength=len(table) + 1)
    assert_array_equal(counts[1:], table[:, 4])
    assert_array_equal(table[:, 6][components[labels > 0] - 1], labels[labels > 0])
    for shares in (columns, rows, histograms[~np.isnan(table[:, 5])]):
        assert_allclose(shares.sum(axis=1, dtype=float), 1, rtol=0, atol=LEVELS * 2**-24)
    assert_array_equal(histograms[np.isnan(table[:, 5])], 0)


@pytest.mark.parametrize("width", [8, 11, 16, 45])
def test_shares_agree_with_opencv(kernels: Kernels, width: int) -> None:
    """Shares of a box with at least a pixel a bin are those of OpenCV's area interpolation."""
    labels = np.ones((60, width), np.uint8)
    labels[1:-1, 1:-1] = np.random.default_rng(width).random((58, width - 2)) < 0.7
    _, _, columns, rows, image = kernels.depth_components(
        labels, labels.astype(np.float32), NEAR, FAR, LEVELS, 8, 60, True
    )
    inside = (image == 1).astype(float)
    ways = (columns, (8, 1), inside.mean(0)[None]), (rows, (1, 8), inside.mean(1)[:, None])
    for shares, size, mean in ways:
        expected = cv2.resize(mean, size, interpolation=cv2.INTER_AREA).ravel()
        assert_allclose(shares[0], expected / expected.sum(), rtol=1e-6)


@given(labeled, st.integers(1, 20))
def test_mirror(labels: Labels, bins: int) -> None:
    """Mirrored labels have mirrored columns, whatever the number of bins."""
    found, mirrored = (
        _core.depth_components(each, np.ones(labels.shape, np.float32), NEAR, FAR, LEVELS, bins, 1, True)
        for each in (labels, np.ascontiguousarray(labels[:, ::-1]))
    )
    for i, (columns, rows) in enumerate(zip(found[2], found[3], strict=True)):
        (same,) = np.unique(mirrored[4][:, ::-1][found[4] == i + 1]) - 1
        assert_array_equal(columns, mirrored[2][same][::-1])
        assert_array_equal(rows, mirrored[3][same])


def test_image_is_optional(kernels: Kernels) -> None:
    """Without an image of components all the rest is the same, and the image is empty."""
    labels = draw("1.122", "1.122", ".1...", "....3")
    depth = depths(labels.shape, 4)
    found = describe(kernels, labels, depth)
    *others, image = kernels.depth_components(labels, depth, NEAR, FAR, LEVELS, BINS, 1, False)
    for one, other in zip(others, found[:4], strict=True):
        assert_array_equal(one, other)
    assert image.shape == (0, 0)
    assert image.dtype == np.int32


@pytest.mark.parametrize("shape", [(0, 5), (5, 0), (0, 0), (4, 5)])
def test_nothing_there(kernels: Kernels, shape: tuple[int, int]) -> None:
    """Without labels, or without pixels, there are no regions, and the images keep their shape."""
    table, histograms, columns, rows, components = describe(
        kernels, np.zeros(shape, np.uint8), np.ones(shape, np.float32)
    )
    assert table.shape == (0, 7)
    assert histograms.shape == (0, LEVELS)
    assert columns.shape == rows.shape == (0, BINS)
    assert_array_equal(components, np.zeros(shape, np.int32))


ONE = np.ones((2, 3), np.uint8)
BAD_VALUES: list[tuple[str, Any, str]] = [
    ("labels", np.ones((3, 2), np.uint8), r"labels: expected shape \(2, 3\), got \(3, 2\)"),
    ("near", -0.1, "near: expected a finite number, not negative, got -0.1"),
    ("near", np.nan, "near: expected a finite number, not negative, got nan"),
    ("far", 0.5, "far: expected a finite number above near, got 0.5"),
    ("far", np.inf, "far: expected a finite number above near, got inf"),
    ("levels", -1, "levels: expected 0 to 4096, got -1"),
    ("bins", -2, "bins: expected 1 to 4096, got -2"),
    ("min_area", 0, "min_area: expected at least 1, got 0"),
]


@pytest.mark.parametrize(("name", "value", "message"), BAD_VALUES)
def test_refuses(kernels: Kernels, name: str, value: Any, message: str) -> None:
    """Labels of another shape than the depth's, and parameters out of their range, are named."""
    arguments: dict[str, Any] = {"labels": ONE, "depth": ONE.astype(np.float32), "near": 0.5, "far": 2.0}
    arguments |= {"levels": 3, "bins": 3, "min_area": 1, "image": False, name: value}
    with pytest.raises(ValueError, match=message):
        kernels.depth_components(**arguments)


BAD: list[tuple[Any, Any, type[Exception], str]] = [
    (ONE.astype(int), ONE.astype(np.float32), TypeError, r"labels: expected uint8 labels \(H, W\), got int"),
    (ONE[0], ONE.astype(np.float32), ValueError, r"labels: expected uint8 labels \(H, W\), got uint8 \(3,\)"),
    (ONE[:, ::2], ONE[:, ::2].astype(np.float32), ValueError, "labels: expected a C-contiguous"),
    (ONE, ONE.astype(float), TypeError, "depth: expected a float32 depth image"),
    (ONE, ONE.astype(np.float32)[:, ::-1], ValueError, "depth: expected packed pixels"),
]


@pytest.mark.parametrize(("labels", "depth", "error", "message"), BAD)
def test_native_refuses(labels: Any, depth: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        describe(_core, labels, depth)
