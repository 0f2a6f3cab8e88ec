# SPDX-License-Identifier: MIT
"""What is at a place: how large, how far away, how much of it hidden, and whether it is the target."""

from typing import NamedTuple

from tricue.track.fused.experts import size
from tricue.track.fused.experts.depth import Measured, measure
from tricue.track.fused.experts.flow import Glance, growth
from tricue.track.fused.experts.size import Looks
from tricue.track.fused.identity import Marks, probability
from tricue.track.fused.localize import Known, Place, closer, peak
from tricue.track.fused.outline import Outline, outline
from tricue.track.fused.sight import Sight
from tricue.track.fused.view import PIXELS, Target, View

INNER, OUTER = 0.8, 2.0  # of the box, inside of it and round it
VAGUE = 0.25  # metres, an expectation of depth that tells little
LEAP = 1.25  # times, that a target grows or shrinks in a frame


class Found(NamedTuple):
    """A place looked at closely: its size and depth measured, its identity judged.

    by_look, log_odds: of its being the target by its look, and by all that is known. answer: the filter's.
    hidden: share of its box before which something nearer is.
    """

    target: Target
    sight: Sight
    marks: Marks
    by_look: float
    log_odds: float
    answer: float
    measured: Measured | None
    hidden: float
    glance: Glance | None
    outline: Outline | None

    @property
    def score(self) -> float:
        """Probability of its being the target."""
        return probability(self.log_odds)


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
    marks = Marks(
        sharpness=place.sharpness,
        order=models.identity.order(looks.ranks[step]),
        colors=models.identity.likeness(view, place.right, place.down),
        contrast=place.contrast,
        first=place.answers[1],
    )
    target = place.target.scaled(min(max(factor, low), high))
    covered = hidden(view, place.right, place.down)
    odds = marks.log_odds(_channels(known, view))
    return Found(
        target,
        view.sight,
        marks,
        odds,
        odds,
        place.answers[0],
        measured,
        covered,
        glance,
        outline(view, place.right, place.down, covered),
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


def continuous(place: Place) -> float:
    """How much what is at a place stands apart at the depth that is expected: mean P(target | depth) in its
    box less that round it, in [0, 1], less the vaguer the expectation; 0 without depth.
    """
    view = place.view
    expected = view.sight.expected
    if view.depth is None or expected is None:
        return 0.0
    own, every = (view.depth[0][view.inner(place.right, place.down, share)] for share in (INNER, OUTER))
    inside, outside = float(own.sum()), float(every.sum()) - float(own.sum())
    contrast = inside / own.size - outside / max(every.size - own.size, 1)
    return max(contrast, 0.0) * min(VAGUE / expected.sigma, 1.0) ** 2


def _channels(known: Known, view: View) -> str:
    if view.sight.kind == "depth":
        return "depth"
    return "color" if known.depth is None or view.depth is None else "both"


def hidden(view: View, right: float = 0.0, down: float = 0.0) -> float:
    """The share of a target's box, so many patch pixels off the middle, that something nearer hides."""
    return 0.0 if view.depth is None else float(view.depth[1][view.inner(right, down, INNER)].mean())


def _factor(known: Known, place: Place, looks: Looks, expected: float) -> tuple[int, float]:
    """The step of scale for which there is most evidence, and the factor that it stands for."""
    models, p, k = known.models, known.p, place.view.sight.k
    total = size.steps(p).prior
    if "ranks" in p.cues:
        total = total + p.rank_weight * models.size.evidence(k, looks)
    if "edges" in p.cues and place.own is not None:
        middle = PIXELS / 2 + place.right, PIXELS / 2 + place.down
        across, down = (expected * each for each in place.view.size)
        total = total + p.edge_weight * size.edges(k, place.own, middle, (across, down), p, models.edge)
    best = int(total.argmax())
    return best, expected * p.scale_step ** (best - p.scales // 2 + peak(total, best))
