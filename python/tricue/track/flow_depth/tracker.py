# SPDX-License-Identifier: MIT
"""The flow and depth tracker of Okada, Shirai and Miura (1996): a person by optical flow, disparity and
Bayes' rule.
"""

import math
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from tricue import kernels as kernel_sets
from tricue.camera.box import Box, BoxLike
from tricue.camera.frame import Frame, FrameLike
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.camera.stereo_check import warn_of_stereo
from tricue.track.base import validation
from tricue.track.base.track import Track
from tricue.track.base.tracker import TrackerBase
from tricue.track.base.traits import Channels, Traits
from tricue.track.flow_depth.blocks import OCCLUDED_BLOCK, TARGET_BLOCK
from tricue.track.flow_depth.complete_occlusion import disparity_in_window, is_back, is_occluded
from tricue.track.flow_depth.cue_input import require_cue_channels
from tricue.track.flow_depth.cues import Cues, measure
from tricue.track.flow_depth.initialize import initialize
from tricue.track.flow_depth.learn import learn
from tricue.track.flow_depth.overlay import block_boxes, target_mask
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.position import locate
from tricue.track.flow_depth.read_cells import CueReach
from tricue.track.flow_depth.rectangles import Rectangle, cells_of, contains, moved
from tricue.track.flow_depth.reduced_frame import ReducedFrame, WantedCells, reduce_frame
from tricue.track.flow_depth.state import FlowDepthState, Velocity
from tricue.track.flow_depth.verged_geometry import VergedGeometry
from tricue.track.flow_depth.verify import candidate_region, verify, verify_by

MIN_REGION_SIDE = 4  # cells, of the measured region
MIN_OCCLUDED_SHARE = 0.5  # of the blocks; from this on a missed target counts as occluded


class FlowDepthTracker(TrackerBase[FlowDepthParams, FlowDepthState]):
    """Follows one person or object among others by its motion and its disparity, also with a moving camera,
    through overtaking and complete occlusion.

    Each frame has ``color`` (BGR or gray), rectified, and ``right`` or ``depth``; depth has to be registered
    to color. If a frame has both, ``right`` isn't used. With ``rig=`` some frames may have one and some the
    other. ``cues`` chooses flow, disparity or both. Flow alone needs only color. Disparity alone with a depth
    camera needs only depth. The box is in pixels of the left image. Tracks have a ``position`` and a
    ``covariance`` with ``rig=`` for a stereo pair, or ``intrinsics=`` for a depth camera.
    ``vergence`` is the angle of a verged stereo pair. The tracker isn't random: the seed changes nothing.

        tracker = tricue.FlowDepthTracker(rig=rig)
        track = tracker.init(frame, box=(x, y, width, height))
        track = tracker.update(frame)
        tracker.mask  # (H, W) 255 where a pixel belongs to the target
    """

    Params = FlowDepthParams

    traits: ClassVar[Traits] = Traits(
        channels=(
            Channels.of("color", "right"),
            Channels.of("color", "depth"),
            Channels.of("color", cues=("flow",)),
            Channels.of("depth", cues=("disparity",)),
        ),
        camera=frozenset({"rig", "intrinsics"}),
        shows=frozenset({"mask", "blocks"}),
        follows="what moves and is as far away as the target; its pixels",
        source="Okada, Shirai, Miura 1996",
    )

    def __init__(
        self,
        params: FlowDepthParams | None = None,
        *,
        rig: StereoRig | None = None,
        intrinsics: Intrinsics | None = None,
        seed: int = 0,
        kernels: kernel_sets.Name = "native",
        **parameters: Any,
    ) -> None:
        super().__init__(params, seed, kernels, parameters)
        self.rig, self.intrinsics = validation.cameras(rig, intrinsics)

    def init(self, frame: FrameLike, box: BoxLike | None = None) -> Track:
        """Start, or start again, on the target in ``box``, (x, y, width, height) in pixels of the left image.

        ValueError without a box, if no part of it is inside the image, and, unless flow is the only cue, if
        its pixels share no disparity or depth. Warns (UserWarning) if left and right seem to be swapped, or
        not rectified.
        """
        checked = require_cue_channels(frame, self.params.cues)
        target = validation.initial_box(box, checked.image.shape)
        by_pair = "disparity" in self.params.cues and _has_pair_alone(checked.frame)
        if by_pair and not self.params.vergence:  # a verged pair's right image isn't rotated back yet
            warn_of_stereo(checked.frame)
        geometry = self._geometry(checked.image.shape, checked.frame)
        reduced = reduce_frame(self._k, checked.frame, geometry, self.params)
        state = initialize(self._k, checked, reduced, geometry, target, self.params)
        shift, candidate = _look_ahead(state, self.params)
        return self._keep(state._replace(shift=shift, candidate=candidate), frame)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        The time between frames follows from their timestamps, or from ``rate`` without them. RuntimeError
        before ``init``. An error leaves the tracker unchanged.
        """
        before = validation.require_initialized(self._state)
        camera = self.rig or self.intrinsics
        checked = require_cue_channels(frame, self.params.cues, before.shape, camera)
        seconds = validation.elapsed(before.timestamp, checked.frame.timestamp, self.params.rate)
        state = _predict(before)
        expected = before.occluder_disparity if _is_completely_occluded(before) else before.disparity
        wanted = self._reach.wanted(state.candidate, expected, before.reduced.gray.shape)
        reduced = reduce_frame(self._k, checked.frame, before.geometry, self.params, wanted)
        region = cells_of(state.candidate, reduced.gray.shape)
        if min(region[2] - region[0], region[3] - region[1]) < MIN_REGION_SIDE:
            state = _coast(state, seconds, pixels=np.zeros_like(state.pixels))
        else:
            cues = measure(self._k, before.reduced, reduced, region, expected, self.params)
            by_disparity = self.params.complete_occlusion == "disparity" and cues.disparity is not None
            follow = self._follow_by_disparity if by_disparity else self._follow
            state = follow(state, cues, seconds)
        shift, candidate = _look_ahead(state, self.params)
        reduced = self._for_next(reduced, wanted, candidate, checked.frame)
        timestamp = checked.frame.timestamp
        state = state._replace(reduced=reduced, shift=shift, candidate=candidate, timestamp=timestamp)
        return self._keep(state, frame)

    @property
    def mask(self) -> NDArray[np.uint8] | None:
        """(H, W) 255 at the target's pixels in the newest frame, else 0; None before ``init``.

        In the first frame it is 0 everywhere.
        """
        return None if self._state is None else target_mask(self._state)

    @property
    def blocks(self) -> tuple[tuple[Box, ...], tuple[Box, ...]]:
        """The boxes of the target blocks, and those of the occluded blocks, of figure 8, pixels; none before
        ``init``.
        """
        if self._state is None:
            return (), ()
        return block_boxes(self._state, TARGET_BLOCK), block_boxes(self._state, OCCLUDED_BLOCK)

    def _follow(self, state: FlowDepthState, cues: Cues, seconds: float) -> FlowDepthState:
        """Sections 4.2 to 4.5: verify that the target is there and learn, or coast while it is missed."""
        p, k = self.params, self._k
        evidence = verify(k, state, cues, p)
        if evidence.found(state, p):
            return learn(k, state, cues, evidence, p)
        blocks = state.blocks
        if not state.missed_seconds:
            blocks = blocks.voted(k, evidence.observed, evidence.limits, p)
        return _coast(
            state,
            seconds,
            region=cues.region,
            pixels=evidence.pixels,
            blocks=blocks,
            occluded=evidence.occluded_share >= MIN_OCCLUDED_SHARE,
        )

    def _follow_by_disparity(self, state: FlowDepthState, cues: Cues, seconds: float) -> FlowDepthState:
        """The same, with complete occlusion as printed in section 4.5."""
        p, k = self.params, self._k
        state = state._replace(region=cues.region, pixels=np.zeros(cues.shape, np.uint8))
        if _is_completely_occluded(state):
            disparity = disparity_in_window(k, state, cues, p)
            if not is_back(state, disparity, cues, p):
                return _coast(state, seconds, occluder_disparity=disparity)
            state = state._replace(
                disparity=disparity, occluder_disparity=math.nan, temporal_window=state.window
            )
        evidence = verify_by(k, state, cues, None, p)
        blocks = state.blocks.voted(k, evidence.observed, evidence.limits, p)
        if is_occluded(state, cues, evidence, blocks, p):
            disparity = disparity_in_window(k, state._replace(occluded=False), cues, p)
            return _coast(state, seconds, blocks=blocks, occluded=True, occluder_disparity=disparity)
        if evidence.has_pixels(state, p.min_pixels):
            return learn(k, state._replace(missed_seconds=0.0), cues, evidence, p)
        return _coast(state, seconds, blocks=blocks, pixels=evidence.pixels, occluded=False)

    def _for_next(
        self, reduced: ReducedFrame, wanted: WantedCells, candidate: Rectangle, frame: Frame
    ) -> ReducedFrame:
        """The frame with the cells that the next frame's flow will read, now that the target's place is
        known.

        They can't be read later, because the caller may write the next frame into the same array.
        """
        needed = self._reach.before(candidate, reduced.gray.shape)
        if frame.color is None or wanted.left is None or contains(wanted.left, needed):
            return reduced
        return reduced._replace(gray=self._k.reduce_gray(frame.color, reduced.step, needed))

    def _derive(self) -> None:
        super()._derive()
        self._reach = CueReach.of(self.params)

    _derived = (*TrackerBase._derived, "_reach")

    def _geometry(self, shape: tuple[int, ...], frame: Frame) -> VergedGeometry:
        """The geometry of the rig, or of the camera with an assumed second one beside it."""
        by_pair, vergence = _has_pair_alone(frame), self.params.vergence
        if self.rig is not None:
            channel = "depth" if frame.color is None else "color"
            return VergedGeometry.of(validation.rig_or_default(self.rig, shape, channel), vergence)
        by_depth = frame.depth is not None and "disparity" in self.params.cues
        camera = validation.camera_or_default(self.intrinsics, shape, "depth" if by_depth else "color")
        assumed = StereoRig(camera, validation.DEFAULT_BASELINE)
        return VergedGeometry.of(assumed, vergence if by_pair else 0.0, is_metric=not by_pair)

    def _track(self, state: FlowDepthState) -> Track:
        """The track of a state."""
        step = state.reduced.step
        x0, y0, x1, y1 = _shown_window(state, self.params)
        box = Box.from_xyxy(step * x0, step * y0, step * x1, step * y1)
        status = state.status(self.params)
        # A stereo pair whose rig isn't given has a disparity, but no distance in meters.
        is_measured = self.rig is not None or state.reduced.right is None
        if "disparity" not in self.params.cues or not (is_measured and state.geometry.is_metric):
            return Track(box, state.score, status)
        position, covariance = locate(self._k, box, state, self.params)
        depth = None if position is None else float(position[2])
        if self.rig is None and self.intrinsics is None:
            return Track(box, state.score, status, depth=depth)
        return Track(box, state.score, status, position, covariance, depth)


def _has_pair_alone(frame: Frame) -> bool:
    """Whether a frame has no depth, so that its disparity must be measured in its stereo pair."""
    return frame.right is not None and frame.depth is None


def _is_completely_occluded(state: FlowDepthState) -> bool:
    """Whether the target is completely occluded until the disparity in its window jumps back."""
    return state.occluded and math.isfinite(state.occluder_disparity)


def _missed_velocity(state: FlowDepthState, p: FlowDepthParams) -> Velocity:
    """The velocity with which a missed target moves on: the mean one, if known."""
    return state.mean_velocity if p.velocity_smoothing and state.learned_frames else state.velocity


def _shown_window(state: FlowDepthState, p: FlowDepthParams) -> Rectangle:
    """The window of the track's box, cells.

    It is the mean of the blocks' window, which is up to a block too large, and of the pixels' outline, which
    is too small; or, as printed, the target window.
    """
    if p.target_window != "outline":
        return state.window
    (x0, y0, x1, y1), (left, top, right, bottom) = state.window, state.outline.rectangle(state.blocks)
    return (x0 + left) / 2, (y0 + top) / 2, (x1 + right) / 2, (y1 + bottom) / 2


def _shift(state: FlowDepthState, p: FlowDepthParams) -> Velocity:
    """The expected motion of the target until the next frame.

    While it is missed it moves on, its center inside the image. After ``lost_after`` its motion is
    unknown: it is searched for where it was last found.
    """
    if not state.missed_seconds:
        return state.velocity
    if state.missed_seconds > p.lost_after:
        return -state.coasted[0], -state.coasted[1]
    right, down = _missed_velocity(state, p)
    x0, y0, x1, y1 = _shown_window(state, p)
    height, width = state.reduced.gray.shape
    x, y = (x0 + x1) / 2, (y0 + y1) / 2
    return min(max(x + right, 0.0), width) - x, min(max(y + down, 0.0), height) - y


def _predict(state: FlowDepthState) -> FlowDepthState:
    """The state moved to where the target is expected in the next frame."""
    right, down = state.shift
    coasted = (state.coasted[0] + right, state.coasted[1] + down) if state.missed_seconds else (0.0, 0.0)
    return state._replace(
        window=moved(state.window, right, down),
        temporal_window=moved(state.temporal_window, right, down),
        blocks=state.blocks.moved(right, down),
        coasted=coasted,
    )


def _look_ahead(state: FlowDepthState, p: FlowDepthParams) -> tuple[Velocity, Rectangle]:
    """The expected motion until the next frame, and its candidate region."""
    shift = _shift(state, p)
    return shift, candidate_region(moved(state.window, *shift), state, p)


def _coast(state: FlowDepthState, seconds: float, **changes: Any) -> FlowDepthState:
    """The state after a frame without the target; nothing is learned."""
    return state._replace(missed_seconds=state.missed_seconds + seconds, score=0.0, **changes)
