# SPDX-License-Identifier: MIT
"""The blocks of section 4.4: which parts of the window belong to the target, and which of them are hidden."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Counts = NDArray[np.int64]

NOT_TARGET, TARGET, OCCLUDED = 0, 1, 2  # figure 7
AROUND = 0.6  # of the window's height, by which the grid is larger on each side: arms and legs go there
LEAST_SIDE = 3.0  # places
MOST = 64  # blocks across or along the window: one as thin as boxes may be would have millions
FIRM = 3  # frames
READ = 0.2  # of a block's places, that need a disparity to tell what is nearer


class Seen(NamedTuple):
    """What a frame shows of each block, (N,): its places in the picture, target pixels among them, those
    with a disparity and their mean, and those with about the target's disparity.
    """

    places: Counts
    targets: Counts
    readings: Counts
    mean: Floats
    alike: Counts

    def nearer(self, than: float) -> Flags:
        """Blocks of something that is nearer than a disparity."""
        return np.asarray((self.mean > than) & (self.readings >= READ * self.places) & (self.places > 0))

    def filled(self, counts: Counts, share: float) -> Flags:
        """Blocks of which a share is counted."""
        return np.asarray((counts >= share * self.places) & (self.places > 0))


class Blocks(NamedTuple):
    """A grid that moves with the target and grows as its disparity does.

    corners: (N, 4) x0, y0, x1, y1 from the anchor, at first. anchor: (2,) places. size: by which the corners
    have grown. states: (N,) of figure 7. votes, against: (N,) frames, as far as they count. core: (N,) those
    of the first window: it was given, so that depth alone keeps them in it, for arms and legs don't move as
    the body does. firm: (N,) frames for which a block's readings count after it had target pixels. idle: (N,)
    frames for which it has had the target's disparity and no target pixels.
    """

    corners: Floats
    anchor: Floats
    size: float
    states: Counts
    votes: Counts
    against: Counts
    core: Flags
    firm: Counts
    idle: Counts

    @classmethod
    def of(cls, window: Rectangle, p: FlowDepthParams) -> "Blocks":
        """A grid over the window and round it; those in the window belong to the target until they are voted
        out. In the paper none does before it is voted in, but the window was given.
        """
        x0, y0, x1, y1 = window
        width, height = x1 - x0, y1 - y0
        side = max(p.block * math.sqrt(width * height), LEAST_SIDE)
        columns, rows = (min(max(round(length / side), 1), MOST) for length in (width, height))
        more = math.ceil(AROUND * rows / 2)
        i, j = np.meshgrid(np.arange(-more, columns + more), np.arange(-more, rows + more))
        left, top = i.ravel() * width / columns - width / 2, j.ravel() * height / rows - height / 2
        corners = np.stack([left, top, left + width / columns, top + height / rows], axis=1)
        none = np.zeros(len(corners), np.int64)
        core = ((i >= 0) & (i < columns) & (j >= 0) & (j < rows)).ravel()
        anchor = np.array([(x0 + x1) / 2, (y0 + y1) / 2])
        return cls(
            corners, anchor, 1.0, np.where(core, TARGET, NOT_TARGET), none, none, core, FIRM * core, none
        )

    def moved(self, right: float, down: float) -> "Blocks":
        """The grid elsewhere."""
        return self._replace(anchor=self.anchor + [right, down])

    @property
    def rectangles(self) -> Floats:
        """(N, 4) x0, y0, x1, y1, places."""
        return self.corners * self.size + np.tile(self.anchor, 2)

    @property
    def window(self) -> Rectangle | None:
        """The rectangle round target and occluded blocks; None without any."""
        mine = self.rectangles[self.states != NOT_TARGET]
        if len(mine) == 0:
            return None
        (x0, y0), (x1, y1) = mine[:, :2].min(axis=0).tolist(), mine[:, 2:].max(axis=0).tolist()
        return x0, y0, x1, y1

    def covered(self, seen: Seen, nearest: float) -> float:
        """Share of the target's blocks, those that are in the picture, that something nearer hides."""
        mine = (self.states != NOT_TARGET) & (seen.places > 0)
        return float((mine & seen.nearer(nearest)).sum() / max(mine.sum(), 1))

    def voted(self, seen: Seen, nearest: float, p: FlowDepthParams) -> "Blocks":
        """The states after a frame. nearest: the disparity from which something hides the target.

        A block of the first window also stays, and comes back, by the target's disparity alone; for a while,
        as the floor round the feet has it too. One of which hardly anything is read gets no vote against it:
        cloth and cardboard without texture.
        """
        found = seen.filled(seen.targets, p.share)
        alike = seen.filled(seen.alike, p.share)
        hidden = seen.nearer(nearest) & ~found
        here = seen.places > 0
        known = seen.readings >= READ * seen.places
        target, occluded = self.states == TARGET, self.states == OCCLUDED
        idle = np.where(found, 0, self.idle + (alike & ~hidden))
        core = self.core & (idle < p.idle)
        votes = np.where(found | (alike & core), self.votes + 1, np.maximum(self.votes - here, 0))
        missing = target & ~found & ~alike & ~hidden & here & known
        against = np.where(missing, self.against + 1, np.where(target & (found | alike), 0, self.against))
        states = self.states.copy()
        states[(states == NOT_TARGET) & (votes >= p.votes)] = TARGET
        states[target & hidden] = OCCLUDED
        states[occluded & ~hidden & (found | (seen.readings > 0))] = TARGET
        states[target & ((against >= p.against) | (idle >= p.idle))] = NOT_TARGET
        gone = states == NOT_TARGET
        firm = np.where(found, FIRM, np.where(hidden, self.firm, np.maximum(self.firm - 1, 0)))
        return self._replace(
            states=states,
            votes=np.where(gone & target, 0, np.minimum(votes, p.votes)),
            against=np.where(gone, 0, against),
            core=core,
            firm=firm,
            idle=idle,
        )
