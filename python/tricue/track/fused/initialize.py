# SPDX-License-Identifier: MIT
"""Creates the models: in the first frame, at the first picture of another kind, and at the first depth."""

from tricue.kernels import Kernels
from tricue.track.fused.depth_object import DepthObject
from tricue.track.fused.depth_sources import ExpectedDepth
from tricue.track.fused.experts.color import ColorExpert
from tricue.track.fused.experts.correlation_filter import CorrelationFilterExpert
from tricue.track.fused.experts.depth import (
    INITIAL_DEPTH_SPREAD,
    DepthExpert,
    DepthMeasurement,
    covered_share,
    measure_depth,
)
from tricue.track.fused.experts.size import SizeExpert
from tricue.track.fused.experts.turn import TurnExpert
from tricue.track.fused.identity import FirstColors
from tricue.track.fused.localize import LocalizationModel, localize
from tricue.track.fused.memory import Memory
from tricue.track.fused.models import AppearanceModels, ModelsByKind
from tricue.track.fused.outline import Sides, measure_reaches
from tricue.track.fused.params import FusedParams
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.position_filter import PositionFilter, back_project
from tricue.track.fused.prepared_frame import PreparedFrame
from tricue.track.fused.state import FusedState
from tricue.track.fused.target import Target
from tricue.track.fused.window import Window, extract_window


def initialize(k: Kernels, frame: PreparedFrame, target: Target, p: FusedParams) -> FusedState:
    """The state after the first frame."""
    measured = measure_depth(frame.for_target(k, None), target, None)
    expected = None if measured is None else ExpectedDepth(measured.z, INITIAL_DEPTH_SPREAD)
    observation = frame.for_target(k, expected)
    depth, position = _depth_models(observation, target, measured, p)
    window = extract_window(observation, target, p.context)
    appearance = _appearance_models(window, p)
    model = LocalizationModel(appearance, depth, target.side, None, p)
    models: ModelsByKind = {observation.kind: appearance}
    return FusedState(
        shape=frame.shape,
        mean_seconds=1 / p.rate,
        models=models,
        memory=Memory(models, models),
        target=target,
        first_side=target.side,
        recognized_side=target.side,
        mean_response=localize(model, window).response,
        sides=_see_sides(Sides.cut_by_border(target, frame.shape), window),
        depth=depth,
        depth_object=DepthObject.from_first(observation, target),
        position=position,
        timestamp=frame.timestamp,
    )


def initialize_depth(state: FusedState, frame: PreparedFrame, k: Kernels, p: FusedParams) -> FusedState:
    """The state with models of the depth at the target's last place, if none was measured before."""
    if state.depth is not None or frame.depth_source is None or state.missed_frames:
        return state
    observation = frame.for_target(k, None)
    measured = measure_depth(observation, state.target, None)
    depth, position = _depth_models(observation, state.target, measured, p)
    if depth is None or measured is None:
        return state
    observation = observation.expect(ExpectedDepth(measured.z, depth.depth_spread))
    return state.replace(
        depth=depth,
        depth_object=DepthObject.from_first(observation, state.target),
        position=position,
        sides=_see_sides(state.sides, extract_window(observation, state.target, p.context)),
    )


def renew_models(state: FusedState, frame: PreparedFrame, k: Kernels, p: FusedParams) -> FusedState:
    """The state with models of the whole object, if the present ones were made from a small part of it."""
    whole = state.depth_object
    if whole is None or whole.seen is None or not whole.outgrew_models or state.position is None:
        return state
    new = initialize(k, frame, Target.of(whole.seen.box), p)
    if new.depth_object is None or new.position is None:
        return state
    return new.replace(
        position=new.position.move_like(state.position),
        score=state.score,
        is_metric=state.is_metric,
        depth_trust=state.depth_trust,
        seconds=state.seconds,
        mean_seconds=state.mean_seconds,
    )


def ensure_models(state: FusedState, observation: PictureObservation, p: FusedParams) -> FusedState:
    """The state with models for the picture's kind; new ones are made where the target should be now."""
    if observation.kind in state.models:
        return state
    appearance = _appearance_models(extract_window(observation, state.target, p.context), p)
    return state.replace(models={**state.models, observation.kind: appearance})


def _appearance_models(window: Window, p: FusedParams) -> AppearanceModels:
    """Models learned from one window."""
    observation, target = window.observation, window.target
    return AppearanceModels(
        CorrelationFilterExpert.from_window(window, p),
        ColorExpert.from_window(window),
        SizeExpert.from_target(observation, target, p),
        TurnExpert.from_target(observation, target, p),
        FirstColors.from_window(window),
    )


def _see_sides(sides: Sides, window: Window) -> Sides:
    """What the first measured depth tells about the sides of the window's target."""
    return sides.see(measure_reaches(window, 0.0, 0.0, covered_share(window), without_support=False))


def _depth_models(
    observation: PictureObservation, target: Target, measured: DepthMeasurement | None, p: FusedParams
) -> tuple[DepthExpert, PositionFilter] | tuple[None, None]:
    """The depth expert and the position filter after the first measurement; None if nothing was measured."""
    if measured is None:
        return None, None
    expert = DepthExpert.from_measurement(measured, target.side * measured.z)
    return expert, PositionFilter.at_rest(*back_project(observation, target, measured), p)
