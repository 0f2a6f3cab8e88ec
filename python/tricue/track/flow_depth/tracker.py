# SPDX-License-Identifier: MIT
"""The flow and depth tracker of Okada, Shirai and Miura (1996): a person by optical flow, disparity and
Bayes' rule.
"""

from typing import Any

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
from tricue.track.flow_depth.blocks import OCCLUDED, TARGET
from tricue.track.flow_depth.cues import Cues, measure
from tricue.track.flow_depth.initialize import initialize
from tricue.track.flow_depth.learn import accepted
from tricue.track.flow_depth.masks import blocks_of, mask_of
from tricue.track.flow_depth.params import FlowDepthParams
from tricue.track.flow_depth.position import located
from tricue.track.flow_depth.rectangles import moved, places_of
from tricue.track.flow_depth.state import FollowState
from tricue.track.flow_depth.verify import candidate, judge
from tricue.track.flow_depth.view import Lens, view_of

MIN_SIDE = 4  # places, of the region that is measured
MIN_HIDDEN = 0.5  # of the blocks, from which what isn't seen is hidden


class FlowDepthTracker(TrackerBase[FlowDepthParams, FollowState]):
    """Follows one person or object among others by what moves and is as far away as it, also with a moving
    camera, through overtaking and complete occlusion.

    Each frame has ``color`` (BGR or gray), rectified, and ``right`` or ``depth``; the depth is that of the
    color image's pixels. ``cues`` chooses flow, disparity or both; flow alone needs color alone, and
    disparity alone of a depth camera depth alone. The box is in the left image. ``position`` and
    ``covariance`` are there with ``rig=`` for a pair, or ``intrinsics=`` for a depth camera. Of a pair that
    is verged, ``vergence`` says by how much. Nothing is random: ``seed`` is taken as by every tracker and
    not used.

        tracker = tricue.FlowDepthTracker(rig=rig)
        track = tracker.init(frame, box=(x, y, width, height))
        track = tracker.update(frame)
        tracker.mask  # (H, W) 255 where a pixel belongs to the target
    """

    Params = FlowDepthParams

    traits = Traits(
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
        """Start, or start again, on what is in ``box``, (x, y, width, height) in pixels of the left image.

        ValueError without a box, where no part of it is inside, and, unless flow is the only cue, where
        nothing in it has a disparity or depth in common. UserWarning where left and right seem to be swapped,
        or not rectified.
        """
        checked = validation.moving(frame, self.params.cues)
        target = validation.initial_box(box, checked.image.shape)
        if "disparity" in self.params.cues and checked.frame.right is not None and not self.params.vergence:
            warn_of_stereo(checked.frame)  # of a verged pair the right image is turned back first
        lens = self._lens(checked.image.shape, checked.frame)
        view = view_of(self._k, checked.frame, lens, self.params)
        return self._keep(initialize(self._k, checked, view, lens, target, self.params))

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        Frames' timestamps tell how long it wasn't seen, ``rate`` where there are none. RuntimeError before
        ``init``. An error leaves the tracker as it was.
        """
        before = validation.started(self._state)
        checked = validation.moving(frame, self.params.cues, before.shape)
        view = view_of(self._k, checked.frame, before.lens, self.params)
        seconds = validation.elapsed(before.timestamp, checked.frame.timestamp, self.params.rate)
        state = _ahead(before)
        region = places_of(candidate(state, self.params), view.gray.shape)
        if min(region[2] - region[0], region[3] - region[1]) < MIN_SIDE:
            state = _missed(state._replace(pixels=np.zeros_like(state.pixels)), seconds)
        else:
            cues = measure(self._k, before.view, view, region, before.disparity, self.params)
            state = self._follow(state, cues, seconds)
        return self._keep(state._replace(view=view, timestamp=checked.frame.timestamp))

    @property
    def mask(self) -> NDArray[np.uint8] | None:
        """(H, W) 255 at the target's pixels in the newest frame, else 0; None before ``init``. In the first
        frame there are none yet.
        """
        return None if self._state is None else mask_of(self._state)

    @property
    def blocks(self) -> tuple[tuple[Box, ...], tuple[Box, ...]]:
        """The target blocks and the occluded blocks of figure 8, pixels; none before ``init``."""
        if self._state is None:
            return (), ()
        return blocks_of(self._state, TARGET), blocks_of(self._state, OCCLUDED)

    def _follow(self, state: FollowState, cues: Cues, seconds: float) -> FollowState:
        """Sections 4.2 to 4.5: verify what is there; accept the target, or coast while it isn't seen."""
        p, k = self.params, self._k
        judged = judge(k, state, cues, p)
        found = judged.found(state, p)
        state = state._replace(region=cues.region, pixels=judged.pixels)
        if found:
            return accepted(k, state, cues, judged, p)
        if not state.missed:
            state = state._replace(blocks=state.blocks.voted(judged.seen, judged.nearest, p))
        return _missed(state._replace(covered=judged.hidden >= MIN_HIDDEN), seconds)

    def _lens(self, shape: tuple[int, ...], frame: Frame) -> Lens:
        if frame.right is not None or self.rig is not None:
            return Lens.of(validation.rig_for(self.rig, shape), self.params.vergence)
        camera = validation.camera_for(self.intrinsics, shape)
        return Lens.of(StereoRig(camera, validation.USUAL_BASELINE), 0.0)

    def _keep(self, state: FollowState) -> Track:
        """The track of a state, which is kept only if there is one."""
        track = self._track(state)
        self._state = state
        return track

    def _track(self, state: FollowState) -> Track:
        """The box is the mean of the blocks' window, which is up to a block too large, and of the pixels'
        outline, which is too small.
        """
        outline = state.outline.rectangle(state.blocks)
        step = state.view.step
        x0, y0, x1, y1 = (step * (a + b) / 2 for a, b in zip(state.window, outline, strict=True))
        box = Box.from_xyxy(x0, y0, x1, y1)
        status = state.status(self.params)
        calibrated = self.rig is not None or (self.intrinsics is not None and state.view.right is None)
        if "disparity" not in self.params.cues or not calibrated:
            return Track(box, state.score, status)
        return Track(box, state.score, status, *located(self._k, box, state, self.params))


def _ahead(state: FollowState) -> FollowState:
    """Where the target is expected next: at its velocity, or the usual one while it isn't seen."""
    right, down = state.steady if state.missed and state.known else state.velocity
    return state._replace(
        window=moved(state.window, right, down),
        temporal=moved(state.temporal, right, down),
        blocks=state.blocks.moved(right, down),
    )


def _missed(state: FollowState, seconds: float) -> FollowState:
    """Coasting: neither model nor blocks learn."""
    return state._replace(missed=state.missed + seconds, score=0.0)
