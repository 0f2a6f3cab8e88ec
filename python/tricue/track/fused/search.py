# SPDX-License-Identifier: MIT
"""Where the target is: in the window round its last place, in those beside it, and in the whole frame."""

import math
from typing import NamedTuple

import numpy as np

from tricue.track.depth_objects.floor import NO_FLOOR
from tricue.track.depth_objects.foreground import extract_foreground
from tricue.track.depth_objects.objects import segment
from tricue.track.depth_objects.params import SegmentationParams
from tricue.track.depth_objects.projection import camera_vector
from tricue.track.fused.examine import Found, continuous, examine, hidden
from tricue.track.fused.experts.depth import measure
from tricue.track.fused.localize import Known, Place, best_place
from tricue.track.fused.params import FusedParams
from tricue.track.fused.sight import Expected, Sight
from tricue.track.fused.space import Space, locate
from tricue.track.fused.view import CELLS, Target, View, look

SEGMENTS = SegmentationParams()
AROUND = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]
DETAIL = 8  # samples a side of the target, where the whole frame is searched by color
MOST_SAMPLES = 256  # a side of the frame
CAUTION = 2.0  # log-odds that structure alone tells less
SIZES = 1.0, 0.7, 1.0, 1.4  # of the last one, of a target that is looked for, by turns
BY_COLOR, BY_TURNS = 3, 3  # windows of the whole frame that are looked at in a frame


class Lost(NamedTuple):
    """Where a target was that isn't where it should be, as large as when it was last recognised: what is seen
    since needn't be it. missed: frames since. turn: whose it is, of the whole frame's windows.
    """

    target: Target
    space: Space | None
    missed: int
    turn: int


def near(known: Known, sight: Sight, guess: Target, usual: float | None) -> Found:
    """Look where the target should be; where its answer isn't as usual, beside that, too. usual: None for
    one that is looked for anywhere, anyway.
    """
    p = known.p
    view = look(sight, [guess], p.context)[0]
    place = best_place(known, view)
    if usual is not None and place.answers[0] < p.doubt * usual:
        places = [_farther(known, view, guess) for view in _beside(sight, guess, p.context)]
        place = max([place, *places], key=lambda each: each.evidence)
    found = examine(known, place)
    likely = found.log_odds + p.continuity * continuous(place)
    if sight.kind == "color":  # it may be lit otherwise now: its structure is enough
        likely = max(likely, found.marks.by_structure - CAUTION)
    return found._replace(log_odds=likely, hidden=max(found.hidden, hidden(view)))


def _farther(known: Known, view: View, guess: Target) -> Place:
    """The best of a view, by evidence less what its distance from the guess takes off."""
    half = known.p.context * guess.side / 2
    far = (view.target.x - guess.x) ** 2 + (view.target.y - guess.y) ** 2
    place = best_place(known, view)
    return place._replace(evidence=place.evidence - known.p.far * far / half**2)


def _beside(sight: Sight, target: Target, context: float) -> list[View]:
    """The eight windows round a target's own, half a window away."""
    half = context * target.side / 2
    return look(sight, [target.moved(i * half, j * half) for i, j in AROUND], context)


def anywhere(known: Known, sight: Sight, lost: Lost, near: Found) -> Found:
    """Look in the whole frame; something else than what is near has to be recognised for sure."""
    p = known.p
    views = _elsewhere(known, sight, lost)
    places = sorted((best_place(known, view) for view in views), key=lambda each: -each.evidence)
    others = [_elsewhere_judged(known, lost, examine(known, place)) for place in places[: p.candidates]]
    best = max(others, key=lambda each: each.log_odds)
    near = near._replace(log_odds=near.log_odds - 0.5 * _distance(known, lost, near) ** 2)
    return best if best.score >= p.found_above and best.log_odds > near.log_odds else near


def _elsewhere_judged(known: Known, lost: Lost, found: Found) -> Found:
    """What was found away from where the target should be, less sure the farther. Without its depth both
    color and structure have to agree, since look-alikes share one of them.
    """
    likely = found.log_odds
    if found.measured is None:
        likely = min(likely, found.marks.by_structure)
    return found._replace(log_odds=likely - 0.5 * _distance(known, lost, found) ** 2)


def _distance(known: Known, lost: Lost, found: Found) -> float:
    """Standard deviations from where the target can be by now."""
    if lost.space is not None and found.measured is not None:
        return lost.space.distance(*locate(found.sight, found.target, found.measured))
    reach = lost.target.side * known.p.reach * (1 + lost.missed)
    return math.hypot(found.target.x - lost.target.x, found.target.y - lost.target.y) / reach


def _elsewhere(known: Known, sight: Sight, lost: Lost) -> list[View]:
    """Windows of the whole frame: where the target's colors are, and some of all, by turns. With depth each
    is as large as the target would be there.
    """
    marked = _colored if sight.depth is None else _apart
    by_color = marked(known, sight, lost.target)
    every = _lattice(sight, lost.target, known.p)
    first = lost.turn * BY_TURNS
    by_turns = [every[(first + i) % len(every)] for i in range(min(BY_TURNS, len(every)))]
    if known.depth is None or sight.ranger is None:
        factor = SIZES[lost.turn % len(SIZES)]
        return look(sight, [each.scaled(factor) for each in by_color + by_turns], known.p.context)
    views = []
    for each in by_color + by_turns:
        views += look(*_there(known, sight, each), known.p.context)
    return views


def _there(known: Known, sight: Sight, target: Target) -> tuple[Sight, list[Target]]:
    """The target at the depth that a place has, and the frame as seen by one who expects it at that."""
    measured = measure(sight, target, None)
    if measured is None or known.depth is None:
        return sight, [target]
    low, high = (bound * known.first_side / target.side for bound in known.p.size_range)
    factor = known.depth.length / (measured.z * target.side)
    expected = Expected(measured.z, known.depth.relief)
    there = target.scaled(min(max(factor, low), high))
    return sight.expecting(expected, there.around), [there]


def _apart(known: Known, sight: Sight, target: Target) -> list[Target]:
    """The target where something stands apart in depth, those of its size first (Sabeti, Parvizi and Wu
    2008, section IV.A).
    """
    assert sight.depth is not None, "the picture is made of depth"
    camera, rng = camera_vector(sight.camera), np.random.default_rng(0)
    seen, plane = extract_foreground(sight.k, sight.depth, camera, NO_FLOOR, rng, SEGMENTS)
    objects = segment(sight.k, seen, plane, SEGMENTS)
    found = []
    for state, box in zip(objects.states.tolist(), objects.boxes(camera), strict=True):
        side = Target.of(box).side
        off = abs(math.log(side * state[2] / known.depth.length)) if known.depth else 0.0
        x, y = box.center
        found.append((off, target._replace(x=x, y=y)))
    found.sort(key=lambda each: each[0])
    return [each for _, each in found[:BY_COLOR]]


def _colored(known: Known, sight: Sight, target: Target) -> list[Target]:
    """The target where its colors stand out most, at least its own side from place to place."""
    height, width = sight.picture.shape[:2]
    k = sight.k
    unit = max(target.side / DETAIL, max(height, width) / MOST_SAMPLES)
    rows, columns = (max(2 * round(length / unit / 2), 2) for length in (height, width))
    samples = k.sample_windows(sight.picture, np.array([[0.0, 0.0, width, height]]), rows, columns)
    flat = np.ascontiguousarray(samples.reshape(1, -1, 3).transpose(0, 2, 1))
    own = k.color_lookup(flat, known.models.color.table).reshape(rows, columns)
    across, down = width / columns, height / rows
    contrast = k.box_contrast(own, target.width / across, target.height / down, known.p.frame, 1.0)
    y = down * (rows // 2 + 2.0 * (np.arange(rows // 2) - rows // 4))[:, None]
    x = across * (columns // 2 + 2.0 * (np.arange(columns // 2) - columns // 4))[None]
    places = []
    for _ in range(BY_COLOR):
        i, j = np.unravel_index(np.argmax(contrast), contrast.shape)
        places.append(target._replace(x=float(x[0, j]), y=float(y[i, 0])))
        near = (np.abs(x - x[0, j]) < target.side) & (np.abs(y - y[i, 0]) < target.side)
        contrast = np.where(near, -np.inf, contrast)
    return places


def _lattice(sight: Sight, target: Target, p: FusedParams) -> list[Target]:
    """The target at places half a window apart, over the whole frame."""
    half = p.context * target.side / 2
    height, width = sight.picture.shape[:2]
    rows, columns = (min(max(int(np.ceil(length / half)), 1), CELLS) for length in (height, width))
    return [
        target._replace(x=(j + 0.5) * width / columns, y=(i + 0.5) * height / rows)
        for i in range(rows)
        for j in range(columns)
    ]
