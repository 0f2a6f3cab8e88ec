# SPDX-License-Identifier: MIT
"""The blocks of section 4.4: the parts of the window that belong to the target or are occluded."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Flags, Floats
from tricue.kernels import Kernels
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, Region

Counts = NDArray[np.int64]
Point = tuple[float, float]
Grid = tuple[Floats, tuple[float, float, float, float, float]]

NOT_TARGET_BLOCK, TARGET_BLOCK, OCCLUDED_BLOCK = 0, 1, 2  # states of figure 7
GRID_MARGIN = 0.6  # of the window's height, half on each side, for arms and legs
MIN_BLOCK_SIDE = 3.0  # cells
MAX_BLOCKS = 64  # across or along the window; the thinnest windows would have millions
TRUSTED_FRAMES = 3  # for which a block stays trusted after it had target pixels
MIN_MEASURED_SHARE = 0.2  # of a block's cells; fewer disparities are inconclusive


class DisparityLimits(NamedTuple):
    """Limits for the mean disparity of a block, cells.

    target: the target's disparity. tolerance: the largest difference of a similar one. occluder: above this,
    something hides the target.
    """

    target: float
    tolerance: float
    occluder: float


class BlockObservation(NamedTuple):
    """The measurements of a frame in each block, (N,) each.

    cells: the number inside the image. target_pixels: the number that belong to the target. measured: the
    number with a disparity. mean_disparity: over the measured ones. same_depth: the number at about the
    target's disparity.
    """

    cells: Counts
    target_pixels: Counts
    measured: Counts
    mean_disparity: Floats
    same_depth: Counts

    @property
    def has_mean(self) -> Flags:
        """Whether (N,) enough cells of a block are measured for their mean to count."""
        return np.asarray((self.measured >= MIN_MEASURED_SHARE * self.cells) & (self.cells > 0))

    def is_nearer(self, limits: DisparityLimits) -> Flags:
        """Whether (N,) a block's mean disparity is that of an occluder."""
        return np.asarray((self.mean_disparity > limits.occluder) & self.has_mean)

    def is_similar(self, limits: DisparityLimits) -> Flags:
        """Whether (N,) a block's mean disparity is similar to the target's."""
        return np.asarray((np.abs(self.mean_disparity - limits.target) <= limits.tolerance) & self.has_mean)

    def has_share(self, counts: Counts, share: float) -> Flags:
        """Whether (N,) the counts are at least a share of a block's cells."""
        return np.asarray((counts >= share * self.cells) & (self.cells > 0))


class Blocks(NamedTuple):
    """A grid that moves with the target and grows as its disparity does.

    corners: (N, 4) x0, y0, x1, y1 relative to the anchor, in the first frame, cells. anchor: x, y, cells.
    size: factor by which the corners have grown. states: (N,) of figure 7.
    votes: (N,) frames in favor of a block becoming a target block, at most as many as are needed.
    votes_against: (N,) frames against it.
    core: (N,) the blocks of the first window. Since the window was given, depth alone keeps them, because
    arms and legs don't move like the body.
    trusted: (N,) frames for which a block still counts in the model after it had target pixels.
    frames_without_pixels: (N,) frames since it had target pixels in which it had the target's disparity.
    """

    corners: Floats
    anchor: Point
    size: float
    states: Counts
    votes: Counts
    votes_against: Counts
    core: Flags
    trusted: Counts
    frames_without_pixels: Counts

    @classmethod
    def of(cls, window: Rectangle, p: FlowDepthParams) -> "Blocks":
        """A grid over the first window and around it.

        The window's blocks belong to the target until they are voted out, since the window was given. By the
        printed rules the grid covers only the window, and every block must be voted in.
        """
        adaptive = p.block_rules == "adaptive"
        x0, y0, x1, y1 = window
        width, height = x1 - x0, y1 - y0
        side = max(p.block_side * math.sqrt(width * height), MIN_BLOCK_SIDE)
        columns, rows = (min(max(round(length / side), 1), MAX_BLOCKS) for length in (width, height))
        margin = math.ceil(GRID_MARGIN * rows / 2) if adaptive else 0
        i, j = np.meshgrid(np.arange(-margin, columns + margin), np.arange(-margin, rows + margin))
        left, top = i.ravel() * width / columns - width / 2, j.ravel() * height / rows - height / 2
        corners = np.stack([left, top, left + width / columns, top + height / rows], axis=1)
        zeros = np.zeros(len(corners), np.int64)
        core = ((i >= 0) & (i < columns) & (j >= 0) & (j < rows)).ravel()
        anchor = (x0 + x1) / 2, (y0 + y1) / 2
        states = np.where(core & adaptive, TARGET_BLOCK, NOT_TARGET_BLOCK)
        return cls(corners, anchor, 1.0, states, zeros, zeros, core, TRUSTED_FRAMES * core, zeros)

    def moved(self, right: float, down: float) -> "Blocks":
        """The grid, moved."""
        x, y = self.anchor
        return Blocks(self.corners, (x + right, y + down), *self[2:])

    def resized(self, size: float) -> "Blocks":
        """The grid, scaled to a size about its anchor."""
        return Blocks(self.corners, self.anchor, size, *self[3:])

    @property
    def rectangles(self) -> Floats:
        """(N, 4) x0, y0, x1, y1, cells."""
        return np.asarray(self.corners * self.size + np.array(2 * self.anchor))

    def grid_in(self, region: Region) -> Grid:
        """The corners, and their place relative to a region's corner, as kernels take them."""
        return self.corners, (self.size, *self.anchor, *region[:2])

    @property
    def window(self) -> Rectangle | None:
        """The rectangle around target and occluded blocks; None if there are none."""
        mine = self.corners.take(self.states.nonzero()[0], axis=0)  # all states but NOT_TARGET_BLOCK
        if len(mine) == 0:
            return None
        # The ufuncs themselves, because the arrays' methods take twice as long for so few numbers.
        left, top, _, _ = np.minimum.reduce(mine).tolist()
        _, _, right, bottom = np.maximum.reduce(mine).tolist()
        (x, y), size = self.anchor, self.size
        return left * size + x, top * size + y, right * size + x, bottom * size + y

    def voted(
        self, k: Kernels, observed: BlockObservation, limits: DisparityLimits, p: FlowDepthParams
    ) -> "Blocks":
        """The blocks after the votes of a frame, figure 7."""
        if p.block_rules == "printed":
            return self._voted_by_pixels(observed, limits, p)
        return self._voted_by_pixels_and_depth(k, observed, limits, p)

    def _voted_by_pixels(
        self, observed: BlockObservation, limits: DisparityLimits, p: FlowDepthParams
    ) -> "Blocks":
        """Section 4.4 as printed: a block without target pixels gets a vote against it, unless something
        nearer is there. Votes add up over all frames in a state.
        """
        found = observed.has_share(observed.target_pixels, p.min_block_share)
        nearer = observed.is_nearer(limits)
        target, occluded = self.states == TARGET_BLOCK, self.states == OCCLUDED_BLOCK
        votes = self.votes + (found & ~target & ~occluded)
        against = self.votes_against + (target & ~found & ~nearer & (observed.cells > 0))
        states = self.states.copy()
        states[votes >= p.votes_to_add] = TARGET_BLOCK
        states[against >= p.votes_to_remove] = NOT_TARGET_BLOCK
        states[target & ~found & nearer] = OCCLUDED_BLOCK
        states[occluded] = np.where(observed.is_similar(limits), TARGET_BLOCK, OCCLUDED_BLOCK)[occluded]
        same = states == self.states
        return self._replace(
            states=states, votes=np.where(same, votes, 0), votes_against=np.where(same, against, 0)
        )

    def _voted_by_pixels_and_depth(
        self, k: Kernels, observed: BlockObservation, limits: DisparityLimits, p: FlowDepthParams
    ) -> "Blocks":
        """The adaptive rules; see the kernel ``block_votes``."""
        frames = p.votes_to_add, p.votes_to_remove, p.votes_to_release, p.max_frames_without_pixels
        votes = k.block_votes(self[3:], observed, limits, (p.min_block_share, *frames))
        return Blocks(self.corners, self.anchor, self.size, *votes)
