# SPDX-License-Identifier: MIT
"""The place in a view for which there is most evidence."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.track.fused.experts import PixelExpert, posterior
from tricue.track.fused.experts.depth import DepthExpert
from tricue.track.fused.experts.flow import Glance
from tricue.track.fused.params import FusedParams
from tricue.track.fused.sight import Plane
from tricue.track.fused.state import Models
from tricue.track.fused.view import CELLS, Target, View, look

OFF = 6  # cells from a window's middle beyond which it is looked at again, from nearer
MIDDLE = CELLS // 2


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


def best_place(known: Known, view: View) -> Place:
    """The place in a view that has most evidence, between cells by a parabola."""
    models, p = known.models, known.p
    answers = models.filter.evidence(view)
    total = (p.filter_weight if "filter" in p.cues else 0.0) * answers[0]
    own = posterior([each.opinion(view) for each in _pixel_experts(known)])
    contrast = None
    if own is not None:
        contrast = view.sight.k.box_contrast(own, *view.size, p.frame, p.around)
        total += p.color_weight * contrast
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
        _sharpness(answer, float(answer[near].max())),
        0.0 if contrast is None else float(contrast[i, j]),
        own,
    )


def _sharpness(answer: Plane, top: float) -> float:
    """Standard deviations by which the top of an answer stands above its mean."""
    mean = float(answer.sum()) / answer.size
    power = float(np.vdot(answer, answer)) / answer.size
    return (top - mean) / max(math.sqrt(max(power - mean * mean, 0.0)), 1e-6)


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


def peak(values: NDArray[np.floating], index: int) -> float:
    """Offset from the largest value of the top of the parabola through it and its neighbours."""
    if not 0 < index < len(values) - 1:
        return 0.0
    before, top, after = values[index - 1 : index + 2].tolist()
    bend = before - 2 * top + after
    return 0.5 * (before - after) / bend if bend < 0 else 0.0
