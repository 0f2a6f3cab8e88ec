# SPDX-License-Identifier: MIT
"""Where the target is: in the window round its last place, in those beside it, and in the whole frame."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.fused.experts import PixelExpert, posterior, size
from tricue.track.fused.experts.depth import DepthExpert, Measured, measure
from tricue.track.fused.experts.flow import Glance, growth
from tricue.track.fused.experts.size import Looks
from tricue.track.fused.identity import Marks, probability
from tricue.track.fused.params import FusedParams
from tricue.track.fused.sight import Expected, Plane, Sight
from tricue.track.fused.state import Models
from tricue.track.fused.view import CELLS, PIXELS, Target, View, look

AROUND = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]
DETAIL = 8  # samples a side of the target, where the whole frame is searched by color
MOST_SAMPLES = 256  # a side of the frame
BY_COLOR, BY_TURNS = 6, 6  # windows of the whole frame that are looked at in a frame
OFF = 6  # cells from a window's middle beyond which it is looked at again, from nearer
MIDDLE = CELLS // 2
LEAP = 1.25  # times, that a target grows or shrinks in a frame


class Known(NamedTuple):
    """What the search goes by. glance: at the target in the last frame."""

    models: Models
    depth: DepthExpert | None
    glance: Glance | None
    first_side: float
    p: FusedParams


class Place(NamedTuple):
    """Where something like the target was found, and the evidence for it.

    right, down: patch pixels off the view's middle. answers: of the learnt and the first frame's filter.
    """

    target: Target
    view: View
    right: float
    down: float
    evidence: float
    answers: tuple[float, float]
    sharpness: float
    contrast: float
    own: Plane | None


class Found(NamedTuple):
    """A place looked at closely: its size and depth measured, its identity judged. hidden: share of its box
    before which something nearer is.
    """

    target: Target
    marks: Marks
    answer: float
    measured: Measured | None
    hidden: float
    glance: Glance | None

    log_odds: float  # of its being the target

    @property
    def score(self) -> float:
        """Probability of its being the target."""
        return probability(self.log_odds)


def best_place(known: Known, view: View) -> Place:
    """The place in a view that has most evidence, between cells by a parabola."""
    models, p = known.models, known.p
    answers = models.filter.evidence(view)
    total = np.float32(p.filter_weight if "filter" in p.cues else 0.0) * answers[0]
    own = posterior([each.opinion(view) for each in _pixel_experts(known)])
    contrast = None
    if own is not None:
        contrast = view.sight.k.box_contrast(own, *view.size, p.frame, p.around)
        total += np.float32(p.color_weight) * contrast
    i, j = divmod(int(total.argmax()), CELLS)
    down, right = i + peak(total[:, j], i) - MIDDLE, j + peak(total[i], j) - MIDDLE
    target = _inside(view.target.moved(2 * view.unit * right, 2 * view.unit * down), view)
    near = slice(max(i - 1, 0), i + 2), slice(max(j - 1, 0), j + 2)
    answer = answers[0]
    return Place(
        target,
        view,
        2 * right,
        2 * down,
        float(total[i, j]),
        (float(answer[i, j]), float(answers[1][near].max())),
        float((answer[near].max() - answer.mean()) / max(float(answer.std()), 1e-6)),
        0.0 if contrast is None else float(contrast[i, j]),
        own,
    )


def _pixel_experts(known: Known) -> list[PixelExpert]:
    experts: list[PixelExpert] = [known.models.color] if "color" in known.p.cues else []
    return [*experts, known.depth] if known.depth is not None else experts


def _inside(target: Target, view: View) -> Target:
    height, width = view.sight.picture.shape[:2]
    return Target(
        min(max(target.x, 0.0), width), min(max(target.y, 0.0), height), target.width, target.height
    )


def closer(known: Known, place: Place) -> Place:
    """The place itself, or what is there seen from nearer, if it was at the edge of its view."""
    if max(abs(place.right), abs(place.down)) <= 2 * OFF:
        return place
    return best_place(known, look(place.view.sight, [place.target], known.p.context)[0])


def examine(known: Known, place: Place) -> Found:
    """Measure the size of what is at a place, and judge whether it is the target."""
    place = closer(known, place)
    models, p, view = known.models, known.p, place.view
    measured = None if known.depth is None else measure(view.sight, place.target, view.sight.expected)
    glance = Glance.at(view, place.right, place.down) if "flow" in p.cues else None
    expected = _foreseen(known, place, measured, glance)
    looks = size.looks(view.sight, place.target.scaled(expected), models.color.table, p)
    step, factor = _factor(known, place, looks, expected)
    low, high = (bound * known.first_side / place.target.side for bound in p.size_range)
    at_depth, hidden = _depths(place)
    marks = Marks(
        sharpness=place.sharpness,
        order=models.identity.order(looks.ranks[step]),
        colors=models.identity.likeness(view, place.right, place.down),
        contrast=place.contrast,
        first=place.answers[1],
        depth=at_depth,
    )
    target = place.target.scaled(min(max(factor, low), high))
    return Found(
        target, marks, place.answers[0], measured, hidden, glance, marks.log_odds(_channels(known, view))
    )


def _foreseen(known: Known, place: Place, measured: Measured | None, glance: Glance | None) -> float:
    """How many times as large as before the target should be: as much as it came nearer, or its pixels moved
    apart.
    """
    if measured is not None and known.depth is not None:
        grown = known.depth.length / (measured.z * place.target.side)
    elif known.glance is not None and glance is not None:
        grown = growth(known.glance, glance, place.view) or 1.0
    else:
        return 1.0
    return min(max(grown, 1 / LEAP), LEAP)


def _channels(known: Known, view: View) -> str:
    if view.sight.kind == "depth":
        return "depth"
    return "color" if known.depth is None or view.depth is None else "both"


def _depths(place: Place) -> tuple[float, float]:
    """Mean P(target | depth) in the box, less its prior, and the share that something nearer hides."""
    view = place.view
    if view.depth is None:
        return 0.0, 0.0
    box = view.inner(place.right, place.down, 0.8)
    return float(view.depth[0][box].mean()) - 0.5, float(view.depth[1][box].mean())


def _factor(known: Known, place: Place, looks: Looks, expected: float) -> tuple[int, float]:
    """The step of scale for which there is most evidence, and the factor that it stands for."""
    models, p, k = known.models, known.p, place.view.sight.k
    offset = np.arange(p.scales) - p.scales // 2.0
    total = -p.scale_prior * offset * offset
    if "ranks" in p.cues:
        total += p.rank_weight * models.size.evidence(k, looks)
    if "edges" in p.cues and place.own is not None:
        middle = _centred(place.own, place.right, place.down)
        across, down = (expected * each for each in place.view.size)
        total += p.edge_weight * size.edges(k, middle, (across, down), size.factors(p), models.edge)
    best = int(total.argmax())
    return best, expected * float(p.scale_step ** (offset[best] + peak(total, best)))


def _centred(plane: Plane, right: float, down: float) -> Plane:
    """The plane moved by whole pixels so that a place off its middle comes to lie there; 0 comes in."""
    i, j = round(down), round(right)
    moved = np.zeros_like(plane)
    rows, columns = PIXELS - abs(i), PIXELS - abs(j)
    from_i, from_j, to_i, to_j = max(i, 0), max(j, 0), max(-i, 0), max(-j, 0)
    moved[to_i : to_i + rows, to_j : to_j + columns] = plane[
        from_i : from_i + rows, from_j : from_j + columns
    ]
    return moved


def beside(sight: Sight, target: Target, context: float) -> list[View]:
    """The eight windows round a target's own, half a window away."""
    half = context * target.side / 2
    return look(sight, [target.moved(i * half, j * half) for i, j in AROUND], context)


def elsewhere(known: Known, sight: Sight, target: Target, count: int) -> list[View]:
    """Windows of the whole frame: where the target's colors are, and some of all, by turns. With depth each
    is as large as the target would be there.
    """
    by_color = _colored(known, sight, target)
    every = _lattice(sight, target, known.p)
    first = count * BY_TURNS
    by_turns = [every[(first + i) % len(every)] for i in range(min(BY_TURNS, len(every)))]
    if known.depth is None or sight.ranger is None:
        return look(sight, by_color + by_turns, known.p.context)
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
    return sight.expecting(expected), [target.scaled(min(max(factor, low), high))]


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


def peak(values: NDArray[np.floating], index: int) -> float:
    """Offset from the largest value of the top of the parabola through it and its neighbours."""
    if not 0 < index < len(values) - 1:
        return 0.0
    before, top, after = values[index - 1 : index + 2].tolist()
    bend = before - 2 * top + after
    return 0.5 * (before - after) / bend if bend < 0 else 0.0
