# SPDX-License-Identifier: MIT
"""What the flow and depth tracker keeps from frame to frame."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.track import Status
from tricue.track.flow_depth.blocks import Blocks
from tricue.track.flow_depth.model import Model
from tricue.track.flow_depth.outline import Outline
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, Region
from tricue.track.flow_depth.view import Lens, View

Velocity = tuple[float, float]

SETTLED = 3  # frames, until the usual velocity is known
RATE = 0.15  # a frame, of the running means
SURE = 0.5  # of the usual number of target pixels, from which their velocity counts in full


class FollowState(NamedTuple):
    """All that changes from frame to frame; lengths are in places."""

    shape: tuple[int, ...]  # of the image
    lens: Lens
    view: View
    window: Rectangle  # of the blocks, section 4.5
    temporal: Rectangle  # round the target pixels
    blocks: Blocks
    outline: Outline
    velocity: Velocity  # a frame
    disparity: float
    first: float  # the same in the first frame
    timestamp: float | None
    region: Region  # in which the target pixels are
    pixels: NDArray[np.uint8]  # (h, w) of the region
    model: Model | None = None
    steady: Velocity = (0.0, 0.0)  # running means while nothing hides it: of the velocity,
    usual: float = 0.0  # of the number of target pixels
    known: int = 0  # frames in them
    score: float = 1.0
    covered: bool = False  # whether something nearer hides it
    missed: float = 0.0  # seconds for which it was not seen

    @property
    def shift(self) -> float:
        """By which a verged pair's disparities are smaller than those of parallel cameras."""
        return self.lens.shift / self.view.step

    @property
    def settled(self) -> bool:
        """Whether the usual velocity is known."""
        return self.known > SETTLED

    def velocity_of(self, measured: Velocity, count: int) -> Velocity:
        """The target's, of the measured one: the fewer the pixels, the more it is as usual."""
        if not self.settled:
            return measured
        sure = min(count / max(SURE * self.usual, 1.0), 1.0)
        (u, v), (steady_u, steady_v) = measured, self.steady
        return steady_u + sure * (u - steady_u), steady_v + sure * (v - steady_v)

    def learned(self, count: int) -> "FollowState":
        """With a frame in which nothing hides the target in the running means; less of it if little is
        seen.
        """
        known = self.known + 1
        rate = max(RATE, 1 / known)
        if known > SETTLED:
            rate *= min(count / max(self.usual, 1.0), 1.0) ** 2
        (u, v), (steady_u, steady_v) = self.velocity, self.steady
        steady = steady_u + rate * (u - steady_u), steady_v + rate * (v - steady_v)
        return self._replace(known=known, steady=steady, usual=self.usual + rate * (count - self.usual))

    def status(self, p: FlowDepthParams) -> Status:
        """OCCLUDED behind something nearer; LOST after a while, sooner where nothing hides it."""
        if self.missed == 0:
            return Status.TRACKED
        if self.missed > p.lost_after or (self.missed > p.unsure and not self.covered):
            return Status.LOST
        return Status.OCCLUDED if self.covered else Status.TRACKED
