# SPDX-License-Identifier: MIT
"""Update the models of a found target: appearance, outline and depth.

A target that is learned slightly off its place is later found slightly off. Over thousands of frames these
errors add up, and the models drift. So if the first frame's filter peaks close to the match, the target is
learned at that peak (Matthews, Ishikawa and Baker 2004, strategy 3). A peak that is low or farther off isn't
used: it comes from another pose, which the first frame doesn't show.
"""

import math

from tricue.track.fused.depth_object import SEARCH_INTERVAL
from tricue.track.fused.depth_sources import DepthImageSource
from tricue.track.fused.experts.depth import covered_share
from tricue.track.fused.localize import clamp_to_image
from tricue.track.fused.measure import Match
from tricue.track.fused.models import AppearanceModels
from tricue.track.fused.outline import Outline, Side, measure_reaches
from tricue.track.fused.params import FusedParams
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.position_filter import PositionFilter, back_project
from tricue.track.fused.state import FusedState
from tricue.track.fused.target import Target
from tricue.track.fused.window import CELL_PIXELS, NO_PLANE, Window, extract_window

MAX_DRIFT = 0.5  # cells, between two updates of appearance
TURN_EVERY = 2  # updates of appearance per update of the turn: more frequent ones are slower and no better
DUE_TOLERANCE = 0.25  # of the time between two frames, by which appearance may be learned early
FRAME = 1 / 30  # seconds: the interval that the learning rates refer to
MIN_FIRST_RESPONSE = 0.2  # of the first frame's filter, whose response to the unchanged target is about 1


def update_models(
    before: FusedState, state: FusedState, observation: PictureObservation, match: Match, p: FusedParams
) -> FusedState:
    """The state with a match blended into its models.

    before: the state after the last frame. Nothing is learned if the target wasn't moved to the match.
    Appearance is learned while the target is followed. At high frame rates it is learned in some of the
    frames only, at higher rates, because targets change with time and not with the number of frames.
    """
    if not state.moved:
        return state
    state = _update_depth(state, observation, match, before.is_lost(p), p)
    state = _update_outline(state, match, p)
    is_due = state.unlearned_seconds + DUE_TOLERANCE * state.seconds >= p.learn_every
    if not state.is_followed(p) or not is_due:
        return state
    if "filter" in p.cues:
        state = state.replace(target=without_drift(state.target, match))
    window = extract_window(observation, state.target, p.context)
    # After a longer interval the rates stay the same: one frame mustn't outweigh the earlier ones.
    seconds = min(state.unlearned_seconds, max(p.learn_every, FRAME))
    appearance_updates = state.appearance_updates + 1
    appearance = _learn_appearance(state.models[observation.kind], window, seconds, p)
    if "turn" in p.cues and appearance_updates % TURN_EVERY == 0:
        appearance = _learn_turn(appearance, window, TURN_EVERY * seconds, p)
    models = {**state.models, observation.kind: appearance}
    return state.replace(models=models, unlearned_seconds=0.0, appearance_updates=appearance_updates)


def without_drift(target: Target, match: Match) -> Target:
    """The target of a match, moved to the peak of the first frame's filter if that is close to the match."""
    candidate, window = match.candidate, match.candidate.window
    peak = window.observation.k.evidence_peak(candidate.first_responses[None], NO_PLANE, 1.0, 0.0).tolist()
    right, down = peak[0] - candidate.right / CELL_PIXELS, peak[1] - candidate.down / CELL_PIXELS
    if peak[2] < MIN_FIRST_RESPONSE or max(abs(right), abs(down)) > MAX_DRIFT:
        return target
    cell = CELL_PIXELS * window.pixel_size
    return clamp_to_image(target.shift(*window.target.along(cell * right, cell * down)), window)


def _learn_appearance(
    models: AppearanceModels, window: Window, seconds: float, p: FusedParams
) -> AppearanceModels:
    size_rate = rate_over(seconds, p.size_learning_rate)
    return models._replace(
        filter=models.filter.learn(window),
        color=models.color.learn(window, rate_over(seconds, p.color_learning_rate)),
        size=models.size.learn(window.observation, window.target, size_rate),
    )


def _learn_turn(models: AppearanceModels, window: Window, seconds: float, p: FusedParams) -> AppearanceModels:
    rate = rate_over(seconds, p.size_learning_rate)
    return models._replace(turn=models.turn.learn(window.observation, window.target, rate))


def rate_over(seconds: float, rate: float) -> float:
    """The learning rate of one step over so many seconds, given the rate per frame."""
    kept: float = (1 - rate) ** (seconds / FRAME)
    return 1 - kept


def update_object(state: FusedState, observation: PictureObservation) -> FusedState:
    """The state with the outline of the target's object, if the target is an object of the depth image.

    A repeated depth image isn't searched: it may be older than the color image that gave the target's place.
    Frames without timestamps may be far apart, so each of them is searched.
    """
    known, position = state.depth_object, state.position
    if known is None or position is None:
        return state
    known = known.wait(SEARCH_INTERVAL if state.timestamp is None else state.seconds)
    is_new = isinstance(observation.depth_source, DepthImageSource) and state.depth_trust.repeats == 0
    if state.missed_frames or not known.is_due or not is_new:
        return state.replace(depth_object=known)
    box = state.outline.apply_to(state.target).box
    known = known.search(observation, state.target, box, float(position.mean[2]))
    if known.seen is None:
        return state.replace(depth_object=known)
    return state.replace(depth_object=known, outline=Outline.of(known.seen.box, state.target))


def _update_outline(state: FusedState, match: Match, p: FusedParams) -> FusedState:
    if state.missed_frames or state.sides.are_hidden or state.depth_object is not None:
        return state
    place = match.candidate.window, match.candidate.right, match.candidate.down
    reaches = measure_reaches(*place, covered_share(*place), without_support=Side.CUT in state.sides)
    if reaches is None:
        return state
    rate = 1 - math.exp(-state.seconds / p.outline_time_constant)
    return state.replace(outline=state.outline.blend(state.sides.outline(reaches), rate))


def _update_depth(
    state: FusedState, observation: PictureObservation, match: Match, was_lost: bool, p: FusedParams
) -> FusedState:
    """Correct the position filter and the depth expert by the measured depth.

    When a LOST target is recognized again, the position filter is restarted. If no depth is measured, a
    recognized target's place in the picture corrects the filter.
    """
    if state.depth is None or state.position is None:
        return state
    if match.depth is None:
        if state.missed_frames:
            return state
        return state.replace(
            position=state.position.correct_bearing(observation.k, state.target, observation.camera)
        )
    if was_lost and state.missed_frames:
        return state
    point, noise = back_project(observation, state.target, match.depth)
    if was_lost:
        return state.replace(position=PositionFilter.at_rest(point, noise, p))
    length = state.target.side * match.depth.z
    depth = state.depth.learn(match.depth, length, p.depth_learning_rate)
    return state.replace(depth=depth, position=state.position.correct(observation.k, point, noise))
