# SPDX-License-Identifier: MIT
"""Regions of a divided depth image and their signatures (Sabeti, Parvizi, Wu 2008, section IV.A)."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Depth
from tricue.reference.base.checks import refuse, require_count
from tricue.reference.base.depth_pixels import has_depth

Labels = NDArray[np.uint8]
Pixels = NDArray[np.intp]
Shares = NDArray[np.float32]

MAX_SIGNATURE = 4096


def depth_components(
    labels: Labels,
    depth: Depth,
    near: float,
    far: float,
    levels: int,
    bins: int,
    min_area: int,
    image: bool,
) -> tuple[NDArray[np.float64], Shares, Shares, Shares, NDArray[np.int32]]:
    """Labels the regions by flood fill, and counts the pixels of each."""
    _require(labels, depth, near, far)
    require_count("levels", levels, 0, MAX_SIGNATURE)
    require_count("bins", bins, 1, MAX_SIGNATURE)
    if min_area < 1:
        refuse("min_area", "at least 1", min_area)
    found = [pixels for pixels in _regions(labels) if len(pixels) >= min_area]
    found.sort(key=len, reverse=True)  # stable

    table = np.empty((len(found), 7))
    histograms = np.empty((len(found), levels), np.float32)
    columns, rows = (np.empty((len(found), bins), np.float32) for _ in range(2))
    components = np.zeros(labels.shape, np.int32)
    for i, pixels in enumerate(found):
        y, x = pixels.T
        z = depth[y, x]
        z = z[has_depth(z)].astype(np.float64)
        size = np.ptp(x) + 1, np.ptp(y) + 1
        mean = z.mean() if z.size else np.nan
        table[i] = x.min(), y.min(), *size, len(x), mean, labels[y[0], x[0]]
        if levels > 0:
            level = np.clip((z - near) * (levels / (far - near)), 0, levels - 1).astype(np.intp)
            histograms[i] = _shares(level, levels)
        columns[i] = _spread(x - x.min(), bins)
        rows[i] = _spread(y - y.min(), bins)
        components[y, x] = i + 1
    return table, histograms, columns, rows, components if image else np.zeros((0, 0), np.int32)


def _require(labels: Labels, depth: Depth, near: float, far: float) -> None:
    if labels.shape != depth.shape:
        refuse("labels", f"shape {depth.shape}", labels.shape)
    if not 0 <= near < np.inf:
        refuse("near", "a finite number, not negative", float(near))
    if not near < far < np.inf:
        refuse("far", "a finite number above near", float(far))


def _regions(labels: Labels) -> Iterator[Pixels]:
    """The pixels (row, column) of each region, regions in the reading order of their first pixels."""
    left = {(int(y), int(x)): labels[y, x] for y, x in np.argwhere(labels)}
    for start in list(left):
        if start not in left:
            continue
        label = left.pop(start)
        pixels = [start]
        for row, column in pixels:  # the list grows while it is read
            for y in (row - 1, row, row + 1):
                for x in (column - 1, column, column + 1):
                    if left.get((y, x)) == label:
                        del left[y, x]
                        pixels.append((y, x))
        yield np.array(pixels, np.intp)


def _shares(parts: Pixels, count: int) -> Shares:
    """The share of the pixels in each part; zeros without pixels."""
    return (np.bincount(parts, minlength=count) / max(parts.size, 1)).astype(np.float32)


def _spread(places: Pixels, bins: int) -> Shares:
    """How the pixels are shared out among equal parts of their range, each by how much of it is there."""
    strips = np.repeat(np.bincount(places), bins)  # as many of each pixel
    shares: Shares = (strips.reshape(bins, -1).sum(axis=1) / (bins * places.size)).astype(np.float32)
    return shares
