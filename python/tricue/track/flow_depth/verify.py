# SPDX-License-Identifier: MIT
"""Verifies that the target is in a frame, by its densities, pixels and blocks, sections 4.1 to 4.5."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.flow_depth.blocks import BlockObservation, DisparityLimits
from tricue.track.flow_depth.cues import Cues
from tricue.track.flow_depth.model import ExpectedPeak, TargetModel, estimate_model
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.rectangles import Rectangle, grown, moved
from tricue.track.flow_depth.state import FlowDepthState

Mask = NDArray[np.uint8]

MIN_CANDIDATE_MARGIN = 4.0  # cells of the paper's images, on each side of the window
CANDIDATE_GROWTH = 0.1  # of the margin, per 1 / ``rate`` seconds for which the target was missed
MAX_GROWTH_FRAMES = 20  # largest number of these intervals that enlarge the margin
MIN_DISPARITY_CHANGE, MIN_DISPARITY_HALF_RANGE = 0.03, 0.3  # of the disparity, for near targets
MIN_TARGET_PIXELS = 8
REDETECTION_OCCLUSION = 0.1  # of the blocks; how many more may be occluded when the target is re-detected


class TargetEvidence(NamedTuple):
    """The evidence for the target in a frame.

    model: used for the search. disparity: the target's, cells. pixels: (h, w) 1 at the target's pixels.
    pixel_count: their number. temporal_window: the rectangle around them. observed: the measurements in the
    blocks. limits: of the target's and the occluders' disparities. occluded_share: of its blocks.
    """

    model: TargetModel
    disparity: float
    pixels: Mask
    pixel_count: int
    temporal_window: Rectangle
    observed: BlockObservation
    limits: DisparityLimits
    occluded_share: float

    def found(self, state: FlowDepthState, p: FlowDepthParams) -> bool:
        """Whether the target is there: it has enough pixels, section 4.5, and isn't almost fully occluded."""
        if state.missed_seconds:
            min_pixels, max_share = p.min_pixels_to_redetect, p.max_occluded_share + REDETECTION_OCCLUSION
        else:
            min_pixels, max_share = p.min_pixels, p.max_occluded_share
        return self.has_pixels(state, min_pixels) and self.occluded_share < max_share

    def has_pixels(self, state: FlowDepthState, share: float) -> bool:
        """Whether there are enough target pixels: at least a share of their mean number."""
        return self.pixel_count >= max(share * state.mean_pixels, MIN_TARGET_PIXELS)


def verify(k: Kernels, state: FlowDepthState, cues: Cues, p: FlowDepthParams) -> TargetEvidence:
    """Find the target's pixels and blocks by the cues; a missed target keeps its previous model."""
    return verify_by(k, state, cues, state.model if state.missed_seconds else None, p)


def verify_by(
    k: Kernels, state: FlowDepthState, cues: Cues, model: TargetModel | None, p: FlowDepthParams
) -> TargetEvidence:
    """The same by a given model and the state's disparity, or else by this frame's model and disparity.

    Without disparities every cell of a block counts as measured.
    """
    x, y = cues.region[:2]
    known = model is not None
    model = model or estimate_in_frame(k, state, cues, p)
    disparity = state.disparity if known or cues.disparity is None else model.peaks[-1]
    limits = disparity_limits(state, disparity, cues.disparity_scale, p)
    x0, y0, x1, y1 = window = moved(state.window, -x, -y)
    center = grown(window, (p.prior_center - 1) * (x1 - x0) / 2, (p.prior_center - 1) * (y1 - y0) / 2)
    box, count, pixels, observed, share = k.observe_target(
        [cue.values for cue in cues.maps],
        (model.densities, model.ranges, model.alternatives),
        (center, moved(state.candidate, -x, -y)),
        p.min_posterior if len(p.cues) > 1 else p.min_posterior_one_cue,
        (p.min_neighbors, p.min_region_share, p.outlier_share),
        cues.disparity and cues.disparity.values,
        state.blocks.grid_in(cues.region),
        state.blocks.states,
        limits,
    )
    seen = BlockObservation(*observed)
    return TargetEvidence(model, disparity, pixels, count, moved(box, x, y), seen, limits, share)


def disparity_limits(
    state: FlowDepthState, disparity: float, scale: float, p: FlowDepthParams
) -> DisparityLimits:
    """The limits of disparities similar to the target's, and of those of occluders. scale: of the cues."""
    thickness = p.thickness * abs(disparity + state.disparity_offset)
    tolerance = max(p.disparity_tolerance, thickness / state.reduced.scale) * scale
    return DisparityLimits(disparity, tolerance, disparity + max(p.occluder_margin * scale, thickness))


def candidate_region(window: Rectangle, state: FlowDepthState, p: FlowDepthParams) -> Rectangle:
    """The candidate region of section 4.1 around a window, cells; it grows while the target is missed."""
    x0, y0, x1, y1 = window
    frames = (
        min(state.missed_seconds * p.rate, MAX_GROWTH_FRAMES) if p.complete_occlusion == "blocks" else 0.0
    )
    growth = 1 + CANDIDATE_GROWTH * frames
    minimum = MIN_CANDIDATE_MARGIN * state.reduced.scale
    across, along = p.margin * (x1 - x0), p.margin * (y1 - y0) / 2
    return grown(window, growth * max(across, minimum), growth * max(along, minimum))


def estimate_in_frame(k: Kernels, state: FlowDepthState, cues: Cues, p: FlowDepthParams) -> TargetModel:
    """The target's model in this frame: its densities in the temporal window, section 4.2.

    Surfaces at other depths, such as the background in the first window, move differently, so flow counts
    only at the target's.
    """
    scale, disparity_scale = state.reduced.scale, cues.disparity_scale
    expected = []
    if cues.flow is not None:
        known = state.has_mean_velocity
        deviation = p.flow_change if known else max(p.flow_change, p.flow_half_range)
        expected += [
            ExpectedPeak(each, deviation * scale, p.flow_half_range * scale) for each in state.velocity
        ]
    same_depth = None
    if cues.disparity is not None:
        parallel = abs(state.disparity + state.disparity_offset)
        change = max(p.disparity_change * disparity_scale, MIN_DISPARITY_CHANGE * parallel)
        half_range = max(p.disparity_half_range * disparity_scale, MIN_DISPARITY_HALF_RANGE * parallel)
        expected.append(ExpectedPeak(state.disparity, change, half_range))
        same_depth = state.disparity, p.disparity_tolerance * disparity_scale
    by_blocks = p.histogram_region == "blocks"
    return estimate_model(
        k,
        cues,
        expected,
        state.temporal_window,
        state.blocks if by_blocks else None,
        same_depth if by_blocks else None,
        state.model,
        p,
    )
