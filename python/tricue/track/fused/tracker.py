# SPDX-License-Identifier: MIT
"""The loop of the fused tracker: predict, observe, search, verify, update the models."""

from typing import Any, ClassVar

import numpy as np

from tricue import kernels as kernel_sets
from tricue.arrays import Floats
from tricue.camera.box import Box, BoxLike
from tricue.camera.depth_check import warn_of_depth
from tricue.camera.frame import FrameLike, as_frame
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.camera.stereo_check import warn_of_stereo
from tricue.track.base import validation
from tricue.track.base.track import Status, Track
from tricue.track.base.tracker import TrackerBase
from tricue.track.base.traits import Channels, Traits
from tricue.track.fused.depth_sources import DepthImageSource, ExpectedDepth, StereoSource
from tricue.track.fused.depth_trust import DepthTrust
from tricue.track.fused.initialize import ensure_models, initialize, initialize_depth, renew_models
from tricue.track.fused.learn import update_models, update_object
from tricue.track.fused.localize import LocalizationModel
from tricue.track.fused.measure import Match
from tricue.track.fused.memory import limit_log_odds
from tricue.track.fused.models import AppearanceModels
from tricue.track.fused.params import FusedParams
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.position_filter import lateral_variances
from tricue.track.fused.prepared_frame import PreparedFrame, prepare_frame, rig_and_camera
from tricue.track.fused.proposals import LostTarget
from tricue.track.fused.redetect import redetect
from tricue.track.fused.search import search_last_place, search_local
from tricue.track.fused.state import FusedState
from tricue.track.fused.target import Target
from tricue.track.fused.verify import verify

# Standard deviations of the errors of guessed cameras, as shares of X, Y, Z:
GUESSED_CAMERA_ERROR = 0.4  # of X and Y; for fields of view of 40 and 90 degrees they are off by 0.4 and 0.7
GUESSED_RIG_ERROR = 0.7  # of X, Y and Z; for baselines of 5 and 25 cm they are off by 0.6 and 1.1
MEAN_INTERVAL_RATE = 0.05  # per frame, of the running mean of the time between frames
UNTIMED_FACTOR = 2.0  # the time between frames without timestamps may be so many times that given by ``rate``


class FusedTracker(TrackerBase[FusedParams, FusedState]):
    """Follows any target by adding up the evidence of several experts, with whatever channels a frame has.

    A correlation filter, the target's colors and its depth localize it. A second filter, in log-polar
    coordinates, and the measured depth give its size. Features that compare a match with the first frame
    verify that it is the target. If they reject it for a third of a second, learning stops and the whole
    frame is searched.

    Frames have ``color`` (BGR or gray), alone or with registered ``depth`` or with ``right``, or ``depth``
    alone; channels may come and go. Tracks have ``position``, ``covariance`` and ``depth`` once depth was
    measured, in the frame of the camera that ``intrinsics=``, or ``rig=`` for a stereo pair, describes. If
    neither is given, a default camera is assumed, so X and Y are a guess. If a stereo pair's ``rig`` isn't
    given, X, Y and Z are a guess, and tracks have no ``depth``. ``covariance`` includes the error of such a
    guess. Nothing is random: ``seed`` is accepted, as by every tracker, but not used.

        tracker = tricue.FusedTracker()
        track = tracker.init(frame, box=(x, y, width, height))
        track = tracker.update(frame)
    """

    Params = FusedParams

    traits: ClassVar[Traits] = Traits(
        channels=(
            Channels.of("color", "right"),
            Channels.of("color", "depth"),
            Channels.of("color"),
            Channels.of("depth"),
        ),
        camera=frozenset({"rig", "intrinsics"}),
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
        """Start, or start again, on ``box``: (x, y, width, height), pixels of the color or left image, or of
        the depth image if there is no color; at least 2 pixels wide and high and partly in the image.

        ValueError without a box. UserWarning if left and right seem to be swapped or not rectified, or if
        depth seems not to be registered to color or not to be in meters. Depth that isn't in meters is left
        out; without color, it raises ValueError.
        """
        prepared = self._prepare(frame, None)
        target = Target.of(validation.initial_box(box, prepared.shape))
        trust, prepared = DepthTrust().examine(prepared, 0.0)
        if isinstance(prepared.depth_source, StereoSource):
            warn_of_stereo(as_frame(frame))
        elif isinstance(prepared.depth_source, DepthImageSource) and prepared.color is not None:
            warn_of_depth(as_frame(frame))
        state = initialize(self._k, prepared, target, self.params)
        return self._keep(state.replace(depth_trust=trust, is_metric=self._is_metric(prepared)), frame)

    def update(self, frame: FrameLike) -> Track:
        """Follow the target into the next frame, of the same size as the first.

        The time between frames follows from their timestamps, or from ``rate`` without them. Depth that isn't
        in meters, or stays the same for half a second while color changes, is left out, with a UserWarning
        the first time. ValueError if depth isn't in meters and there is no color. RuntimeError before
        ``init``. An error leaves the tracker unchanged.
        """
        before = validation.require_initialized(self._state)
        prepared = self._prepare(frame, before.shape)
        seconds = validation.elapsed(before.timestamp, prepared.timestamp, self.params.rate)
        trust, prepared = before.depth_trust.examine(prepared, seconds)
        state = self._predict(before, prepared, trust, seconds)
        state = initialize_depth(state, prepared, self._k, self.params)
        observation = prepared.for_target(self._k, _expected_depth(state))
        state = ensure_models(state, observation, self.params)
        match = self._penalize_jump(state, self._search(state, observation))
        match = self._limit_log_odds(state, match)
        state = verify(state, match, self.params)
        state = update_models(before, state, observation, match, self.params)
        state = update_object(state, observation)
        return self._keep(renew_models(state, prepared, self._k, self.params), frame)

    def _prepare(self, frame: FrameLike, shape: tuple[int, int] | None) -> PreparedFrame:
        cameras = self.rig, self.intrinsics
        return prepare_frame(frame, shape, cameras, "depth" in self.params.cues)

    def _predict(
        self, state: FusedState, prepared: PreparedFrame, trust: DepthTrust, seconds: float
    ) -> FusedState:
        """The state predicted for the frame, so many seconds later."""
        position, motion = state.position, state.motion
        if state.is_late():
            position, motion = position and position.stop(self.params), motion.interrupt()
        if position is not None:
            position = position.slow_down() if state.missed_frames else position
            rate = self.params.rate / UNTIMED_FACTOR
            passed = validation.elapsed(state.timestamp, prepared.timestamp, rate)
            position = position.predict(self._k, passed, self.params)
        # Depth is measured along the image's axes: with depth the target is upright and has an outline.
        upright = state.target if prepared.depth_source is None else state.target._replace(turn=0)
        return state.replace(
            target=upright,
            position=position,
            motion=motion,
            depth_trust=trust,
            is_metric=state.is_metric and self._is_metric(prepared),
            timestamp=prepared.timestamp,
            unlearned_seconds=state.unlearned_seconds + seconds,
            seconds=seconds,
            mean_seconds=state.mean_seconds + MEAN_INTERVAL_RATE * (seconds - state.mean_seconds),
            frames=state.frames + 1,
        )

    def _is_metric(self, prepared: PreparedFrame) -> bool:
        """Whether the frame's depths are in meters: those of a stereo pair are only if its rig is known."""
        return self.rig is not None or not isinstance(prepared.depth_source, StereoSource)

    def _search(self, state: FusedState, observation: PictureObservation) -> Match:
        """The best match near the target's last place; in the whole frame if the target isn't followed."""
        p = self.params
        model = _localization_model(state, state.models[observation.kind], p)
        if state.is_followed(p):
            return search_local(model, observation, state.target, state.mean_response)
        local = search_last_place(model, observation, state.target)
        last = state.target.scale(state.recognized_side / state.target.side)
        lost = LostTarget(last, state.position, state.missed_frames, state.frames)
        return redetect(model, observation, lost, local, state.clutter.min_log_odds(p))

    def _penalize_jump(self, state: FusedState, match: Match) -> Match:
        """The match with its log-odds reduced by the penalty for its jump."""
        penalty = state.motion.penalty(state.target, match.target, state.seconds, self.params.jump_weight)
        return match._replace(log_odds=match.log_odds - penalty)

    def _limit_log_odds(self, state: FusedState, match: Match) -> Match:
        """The match with log-odds limited by the older models; not with depth, which shows occluders."""
        models = state.memory.older.get(match.observation.kind)
        if match.observation.depth_source is not None or models is None:
            return match
        return limit_log_odds(_localization_model(state, models, self.params), match)

    def _track(self, state: FusedState) -> Track:
        if state.missed_frames == 0:
            status = Status.TRACKED
        elif state.occluded or not state.is_lost(self.params):
            status = Status.OCCLUDED
        else:
            status = Status.LOST
        box = state.outline.apply_to(state.target.upright).box
        return Track(box, state.score, status, *self._estimate(state, box))

    def _estimate(
        self, state: FusedState, box: Box
    ) -> tuple[Floats, Floats, float | None] | tuple[None, None, None]:
        """The position, covariance and depth of a track with that box; None until depth is measured.

        Depth is None, too, if the stereo rig is a guess.
        """
        if state.position is None or state.depth is None:
            return None, None, None
        position = state.position.position
        camera = rig_and_camera(self.rig, self.intrinsics, state.shape)[1]
        covariance = state.position.error_covariance(state.depth.depth_spread)
        right, down = lateral_variances(state.target, box, float(position[2]), camera)
        covariance[0, 0] += right
        covariance[1, 1] += down
        if not state.is_metric:
            error = GUESSED_RIG_ERROR * position
            return position, covariance + np.outer(error, error), None
        if self.rig is None and self.intrinsics is None:
            error = GUESSED_CAMERA_ERROR * position * (1, 1, 0)
            covariance = covariance + np.outer(error, error)
        return position, covariance, float(position[2])


def _localization_model(state: FusedState, appearance: AppearanceModels, p: FusedParams) -> LocalizationModel:
    return LocalizationModel(appearance, state.depth, state.first_side, state.typical, p)


def _expected_depth(state: FusedState) -> ExpectedDepth | None:
    if state.position is None or state.depth is None:
        return None
    return state.position.expected_depth(state.depth.depth_spread)
