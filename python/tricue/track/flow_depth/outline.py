# SPDX-License-Identifier: MIT
"""The target's outline: the ends of its pixels on each side, learned in frames without occlusion."""

from typing import NamedTuple

from tricue.track.flow_depth.blocks import Blocks
from tricue.track.flow_depth.rectangles import Rectangle

OUTLINE_RATE = 0.2  # per frame; a walker's outline gets wider and narrower with each step


class PixelOutline(NamedTuple):
    """A rectangle relative to the blocks: corners from their anchor, in cells of the first frame's size."""

    edges: Rectangle

    @classmethod
    def of(cls, window: Rectangle, blocks: Blocks) -> "PixelOutline":
        """The outline that equals a window at present."""
        return cls(_to_relative(window, blocks))

    def learned(self, pixels: Rectangle, blocks: Blocks) -> "PixelOutline":
        """The outline moved toward the rectangle around the target's pixels in this frame."""
        measured = _to_relative(pixels, blocks)
        x0, y0, x1, y1 = (
            old + OUTLINE_RATE * (new - old) for old, new in zip(self.edges, measured, strict=True)
        )
        return PixelOutline((x0, y0, x1, y1))

    def rectangle(self, blocks: Blocks) -> Rectangle:
        """The outline at the blocks' present place, in cells of this frame."""
        (x, y), size = blocks.anchor, blocks.size
        x0, y0, x1, y1 = self.edges
        return x0 * size + x, y0 * size + y, x1 * size + x, y1 * size + y


def _to_relative(window: Rectangle, blocks: Blocks) -> Rectangle:
    x, y = blocks.anchor
    x0, y0, x1, y1 = window
    return (x0 - x) / blocks.size, (y0 - y) / blocks.size, (x1 - x) / blocks.size, (y1 - y) / blocks.size
