# SPDX-License-Identifier: MIT
"""Connected regions of skin: where to search for a lost face."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from tricue.reference.cues.color.skin_boundary import skin_boundary


def skin_blobs(
    image: NDArray[np.uint8], reference: NDArray[np.uint8], threshold: float, min_area: int
) -> NDArray[np.float64]:
    """Labels the skin mask by flood fill, and sorts the regions."""
    if min_area < 1:
        raise ValueError(f"min_area: expected at least 1, got {min_area}")
    if not -1.0 <= threshold <= 1.0:
        raise ValueError(f"threshold: expected a number in [-1, 1], got {threshold:g}")
    skin = skin_boundary(image, reference) > 255 * threshold
    blobs = [_describe(pixels) for pixels in _components(skin) if len(pixels) >= min_area]
    blobs.sort(key=lambda blob: (-blob[4], blob[1], blob[0]))
    return np.array(blobs, dtype=np.float64).reshape(-1, 7)


def _components(skin: NDArray[np.bool_]) -> Iterator[list[tuple[int, int]]]:
    """The pixels (row, column) of each region, regions in the reading order of their first pixels."""
    left = {(int(row), int(column)) for row, column in np.argwhere(skin)}
    for start in sorted(left):
        if start not in left:
            continue
        left.remove(start)
        pixels = [start]
        for row, column in pixels:  # the list grows while it is read
            for y in (row - 1, row, row + 1):
                for x in (column - 1, column, column + 1):
                    if (y, x) in left:
                        left.remove((y, x))
                        pixels.append((y, x))
        yield pixels


def _describe(pixels: list[tuple[int, int]]) -> tuple[float, ...]:
    rows, columns = np.array(pixels).T
    x, y = columns.min(), rows.min()
    width, height = columns.max() + 1 - x, rows.max() + 1 - y
    return x, y, width, height, len(pixels), columns.mean() + 0.5, rows.mean() + 0.5
