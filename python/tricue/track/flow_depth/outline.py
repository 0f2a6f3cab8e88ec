# SPDX-License-Identifier: MIT
"""The target's outline: where its pixels end, on each side, in the frames in which nothing hides it."""

from typing import NamedTuple

from tricue.track.flow_depth.blocks import Blocks
from tricue.track.flow_depth.rectangles import Rectangle

RATE = 0.2  # a frame: a walker's outline breathes with the steps


class Outline(NamedTuple):
    """Corners from the anchor of the blocks, in places as large as at first."""

    edges: Rectangle

    @classmethod
    def of(cls, window: Rectangle, blocks: Blocks) -> "Outline":
        """The outline that a window is."""
        return cls(_relative(window, blocks))

    def learned(self, pixels: Rectangle, blocks: Blocks) -> "Outline":
        """Nearer to the rectangle round the target's pixels in this frame."""
        found = _relative(pixels, blocks)
        x0, y0, x1, y1 = (old + RATE * (new - old) for old, new in zip(self.edges, found, strict=True))
        return Outline((x0, y0, x1, y1))

    def rectangle(self, blocks: Blocks) -> Rectangle:
        """Places, where the blocks are now."""
        x, y = blocks.anchor.tolist()
        x0, y0, x1, y1 = (edge * blocks.size for edge in self.edges)
        return x0 + x, y0 + y, x1 + x, y1 + y


def _relative(window: Rectangle, blocks: Blocks) -> Rectangle:
    x, y = blocks.anchor.tolist()
    x0, y0, x1, y1 = window
    return (x0 - x) / blocks.size, (y0 - y) / blocks.size, (x1 - x) / blocks.size, (y1 - y) / blocks.size
