# SPDX-License-Identifier: MIT
"""The fused tracker: color, depth and motion in one."""

import math
from typing import Any

import numpy as np

from tricue import kernels as kernel_sets
from tricue.camera.box import BoxLike
from tricue.camera.frame import FrameLike, as_frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.camera.stereo_check import warn_of_stereo
from tricue.track.base import validation
from tricue.track.base.track import Status, Track
from tricue.track.base.tracker import TrackerBase
from tricue.track.base.traits import Channels, Traits
from tricue.track.fused import learn
from tricue.track.fused.depth_sources import Pair
from tricue.track.fused.examine import Found
from tricue.track.fused.localize import Known
from tricue.track.fused.observation import Seen, read
from tricue.track.fused.params import FusedParams
from tricue.track.fused.search import Lost, anywhere, near
from tricue.track.fused.sight import Expected, Sight
from tricue.track.fused.state import State
from tricue.track.fused.verify import judged
from tricue.track.fused.view import Target

UNSURE = 3.0  # metres, at most, of the depth that is expected


class FusedTracker(TrackerBase[FusedParams, State]):
    """Follows any target by experts whose opinions add up, in whatever channels a frame has, and says when
    it isn't the target.

    A correlation filter, the target's colors and its depth say where it is; its ranks at eleven sizes, the
    edge of its colors and its distance how large; models that keep the first frame whether it is the target.
    Where it isn't, nothing is learnt, and the search widens to the whole frame.

    Frames have ``color`` (BGR or gray), alone or with registered ``depth`` or with ``right``, or ``depth``
    alone; channels may come and go. ``position`` and ``covariance`` are there once depth was measured, in the
    frame of the camera that ``intrinsics=``, or ``rig=`` for a pair, describes. Nothing is random: ``seed``
    is taken as by every tracker and not used.

        tracker = tricue.FusedTracker()
        track = tracker.init(frame, box=(x, y, width, height))
        track = tracker.update(frame)
    """

    Params = FusedParams

    traits = Traits(
        channels=(
            Channels.of("color", "right"),
            Channels.of("color", "depth"),
            Channels.of("color"),
            Channels.of("depth"),
        ),
        camera=frozenset({"rig", "intrinsics"}),
        guesses=True,
        follows="any target in a box, by every cue that the frames have",
        source="ours, of [published parts](docs/fused.md#sources)",
    )

    def __init__(
        self,
        params: FusedParams | None = None,
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
        """Start, or start again, on ``box``, at least 2 pixels wide and high, a part of it in the image.

        UserWarning where left and right seem to be swapped, or not rectified.
        """
        seen = self._read(frame, None)
        target = Target.of(validation.initial_box(box, seen.shape))
        if isinstance(seen.ranger, Pair):
            warn_of_stereo(as_frame(frame))
        self._state = state = learn.begin(self._k, seen, target, self.params)
        return self._track(state)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        Timestamps tell the 3-D filter how long it was, ``rate`` where there are none. RuntimeError before
        ``init``. An error leaves the tracker as it was.
        """
        before = validation.started(self._state)
        seen = self._read(frame, before.shape)
        state = learn.located(self._ahead(before, seen), seen, self._k, self.params)
        sight = seen.sight(self._k, _expected(state), state.target.around)
        state = learn.met(state, sight, self.params)
        found = self._found(state, sight)
        state = judged(state, found, self.params)
        self._state = state = learn.learnt(before, state, sight, found, self.params)
        return self._track(state)

    def _read(self, frame: FrameLike, shape: tuple[int, int] | None) -> Seen:
        return read(self._k, frame, shape, (self.rig, self.intrinsics), "depth" in self.params.cues)

    def _ahead(self, state: State, seen: Seen) -> State:
        """The state when this frame was taken."""
        seconds = validation.elapsed(state.timestamp, seen.timestamp, self.params.rate)
        space = state.space
        if space is not None:
            space = (space.slowed() if state.missed else space).predicted(self._k, seconds, self.params)
        frames = state.frames + 1
        return state._replace(space=space, timestamp=seen.timestamp, seconds=seconds, frames=frames)

    def _found(self, state: State, sight: Sight) -> Found:
        """The target near where it should be; if it wasn't there in the last frame, anywhere."""
        known = Known(state.models[sight.kind], state.depth, state.glance, state.first_side, self.params)
        share = self.params.drift
        guess = state.target.moved(share * state.velocity[0], share * state.velocity[1])
        found = near(known, sight, guess, None if state.missed else state.usual)
        if not state.missed:
            return found
        target = state.target.scaled(state.side / state.target.side)
        return anywhere(known, sight, Lost(target, state.space, state.missed, state.frames), found)

    def _track(self, state: State) -> Track:
        if state.missed == 0:
            status = Status.TRACKED
        elif state.hidden or not state.lost(self.params):
            status = Status.OCCLUDED
        else:
            status = Status.LOST
        space = state.space
        where = (None, None) if space is None else (space.position, space.uncertainty)
        return Track(state.outline.around(state.target).box, state.score, status, *where)


def _expected(state: State) -> Expected | None:
    if state.space is None or state.depth is None:
        return None
    sigma = min(math.sqrt(float(state.space.covariance[2, 2])), UNSURE)
    return Expected(max(float(state.space.mean[2]), 0.05), float(np.hypot(sigma, state.depth.relief)))
