# SPDX-License-Identifier: MIT
"""The state that the flow and depth tracker keeps from frame to frame."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.base.track import Status
from tricue.track.flow_depth.blocks import Blocks
from tricue.track.flow_depth.model import TargetModel
from tricue.track.flow_depth.outline import PixelOutline
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, Region
from tricue.track.flow_depth.reduced_frame import ReducedFrame
from tricue.track.flow_depth.verged_geometry import VergedGeometry

Velocity = tuple[float, float]

MIN_LEARNED_FRAMES = 3  # the mean velocity is used only after more than this
MEAN_RATE = 0.15  # per frame, of running means
MIN_PIXELS_FOR_VELOCITY = 0.5  # of their mean number; from this on the measured velocity counts in full


class FlowDepthState(NamedTuple):
    """Everything that changes from frame to frame; lengths are in cells."""

    shape: tuple[int, ...]  # of the image
    geometry: VergedGeometry
    reduced: ReducedFrame  # the newest frame
    window: Rectangle  # around the blocks, section 4.5
    shift: Velocity  # expected until the next frame
    candidate: Rectangle  # where the target may be in the next frame, section 4.1
    temporal_window: Rectangle  # around the target pixels, section 4.3
    blocks: Blocks
    outline: PixelOutline
    velocity: Velocity  # a frame
    disparity: float
    first_disparity: float
    timestamp: float | None
    region: Region  # that contains the pixels
    pixels: NDArray[np.uint8]  # (h, w) in the region, 1 at the target's pixels
    model: TargetModel | None = None
    mean_velocity: Velocity = (0.0, 0.0)  # running mean over frames with little occlusion
    mean_pixels: float = 0.0  # running mean of the number of target pixels over the same frames
    learned_frames: int = 0  # the number of these frames
    score: float = 1.0
    occluded: bool = False  # whether something nearer hides the target
    occluder_disparity: float = math.nan  # in the window, while its jumps decide on complete occlusion
    missed_seconds: float = 0.0  # since the target was last found
    coasted: Velocity = (0.0, 0.0)  # how far it was moved on since then

    @property
    def disparity_offset(self) -> float:
        """How much smaller a verged pair's disparities are than those of parallel cameras, cells."""
        return self.geometry.offset / self.reduced.step

    @property
    def has_mean_velocity(self) -> bool:
        """Whether the mean velocity has enough frames."""
        return self.learned_frames > MIN_LEARNED_FRAMES

    def smooth_velocity(self, measured: Velocity, count: int) -> Velocity:
        """The velocity, from one measured by ``count`` target pixels: with fewer it is closer to the mean."""
        if not self.has_mean_velocity:
            return measured
        weight = min(count / max(MIN_PIXELS_FOR_VELOCITY * self.mean_pixels, 1.0), 1.0)
        (u, v), (mean_u, mean_v) = measured, self.mean_velocity
        return mean_u + weight * (u - mean_u), mean_v + weight * (v - mean_v)

    def with_means(self, count: int, outline: PixelOutline) -> "FlowDepthState":
        """The state with a new outline, and with a frame of ``count`` target pixels in its running means,
        where few count less.
        """
        frames = self.learned_frames + 1
        rate = max(MEAN_RATE, 1 / frames)
        if frames > MIN_LEARNED_FRAMES:
            rate *= min(count / max(self.mean_pixels, 1.0), 1.0) ** 2
        (u, v), (mean_u, mean_v) = self.velocity, self.mean_velocity
        velocity = mean_u + rate * (u - mean_u), mean_v + rate * (v - mean_v)
        pixels = self.mean_pixels + rate * (count - self.mean_pixels)
        return self._replace(
            outline=outline, learned_frames=frames, mean_velocity=velocity, mean_pixels=pixels
        )

    def status(self, p: FlowDepthParams) -> Status:
        """OCCLUDED behind something nearer; LOST after a while, sooner where nothing hides the target: until
        then such a target stays TRACKED, at a score of 0.
        """
        if self.missed_seconds == 0:
            return Status.TRACKED
        if self.missed_seconds > p.lost_after or (
            self.missed_seconds > p.unoccluded_lost_after and not self.occluded
        ):
            return Status.LOST
        return Status.OCCLUDED if self.occluded else Status.TRACKED
