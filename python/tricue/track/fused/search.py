# SPDX-License-Identifier: MIT
"""Where the target is: in the window round its last place, in those beside it, and in the whole frame."""

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.fused import scale
from tricue.track.fused.params import FusedParams
from tricue.track.fused.state import Found, Models, Place, State
from tricue.track.fused.view import CELLS, Image, Plane, Target, View, look

AROUND = [(i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if i or j]
DETAIL = 8  # samples a side of the target, where the whole frame is searched by color
MOST_SAMPLES = 256  # a side of the frame
BY_COLOR, BY_TURNS = 6, 6  # windows of the whole frame that are looked at in a frame


def evidence(k: Kernels, models: Models, view: View, p: FusedParams) -> tuple[Plane, Plane]:
    """(32, 32) of all experts for the target's centre at each cell, and what the filter alone answers."""
    answer = models.filter.evidence(k, view)
    total = np.zeros_like(answer)
    if "filter" in p.cues:
        total += np.float32(p.filter_weight) * answer
    if "color" in p.cues:
        total += np.float32(p.color_weight) * models.color.evidence(k, view)
    return total, answer


def best_place(k: Kernels, models: Models, view: View, p: FusedParams) -> Place:
    """The place in a view that has most evidence, between cells by a parabola."""
    total, answer = evidence(k, models, view, p)
    i, j = (int(each) for each in np.unravel_index(np.argmax(total), total.shape))
    down, right = i + peak(total[:, j], i) - CELLS // 2, j + peak(total[i], j) - CELLS // 2
    target = view.target.moved(2 * view.unit * right, 2 * view.unit * down)
    height, width = view.image.shape[:2]
    inside = target._replace(x=min(max(target.x, 0.0), width), y=min(max(target.y, 0.0), height))
    return Place(inside, view, float(total[i, j]), float(answer[i, j]))


def examine(k: Kernels, state: State, place: Place, p: FusedParams, steps: NDArray[np.float64]) -> Found:
    """Measure the size of what is at a place, and judge whether it is the target."""
    models, image = state.models, place.view.image
    target = resized(k, state, place, p, steps)
    view = look(k, image, [target], p.context)[0]
    looks = scale.looks(k, image, target, models.color.table, p, steps)
    marks = models.identity.marks(k, view, looks.ranks[len(steps) // 2], models.filter, models.color)
    return Found(target, view, looks, marks, place.answer)


def resized(k: Kernels, state: State, place: Place, p: FusedParams, steps: NDArray[np.float64]) -> Target:
    """The target at a place with the size for which there is most evidence."""
    models, image, target = state.models, place.view.image, place.target
    offset = np.arange(len(steps)) - len(steps) // 2
    total = -p.scale_prior * offset.astype(np.float64) ** 2
    if "ranks" in p.cues:
        total += p.rank_weight * models.scale.evidence(
            k, scale.looks(k, image, target, models.color.table, p, steps)
        )
    if "edges" in p.cues:
        view = look(k, image, [target], p.context)[0]
        total += p.edge_weight * scale.edges(
            k, models.color.posterior(k, view), view.size, steps, models.edge
        )
    best = int(np.argmax(total))
    factor = p.scale_step ** (offset[best] + peak(total, best))
    low, high = (bound * state.first_side / target.side for bound in p.size_range)
    return target.scaled(min(max(factor, low), high))


def beside(k: Kernels, image: Image, target: Target, context: float) -> list[View]:
    """The eight windows round a target's own, half a window away."""
    half = context * target.side / 2
    return look(k, image, [target.moved(i * half, j * half) for i, j in AROUND], context)


def elsewhere(k: Kernels, state: State, image: Image, p: FusedParams) -> list[View]:
    """Windows of the whole frame: where the target's colors are, and some of all, by turns."""
    by_color = _colored(k, state, image, p)
    every = _lattice(state, image, p)
    first = state.count * BY_TURNS
    by_turns = [every[(first + i) % len(every)] for i in range(min(BY_TURNS, len(every)))]
    return look(k, image, by_color + by_turns, p.context)


def _colored(k: Kernels, state: State, image: Image, p: FusedParams) -> list[Target]:
    """The target where its colors stand out most, at least its own side from place to place."""
    height, width = image.shape[:2]
    target = state.target
    unit = max(target.side / DETAIL, max(height, width) / MOST_SAMPLES)
    rows, columns = (max(2 * round(length / unit / 2), 2) for length in (height, width))
    samples = k.sample_windows(image, np.array([[0.0, 0.0, width, height]]), rows, columns)
    flat = np.ascontiguousarray(samples.reshape(1, -1, 3).transpose(0, 2, 1))
    posterior = k.color_lookup(flat, state.models.color.table).reshape(rows, columns)
    across, down = width / columns, height / rows
    contrast = k.box_contrast(posterior, target.width / across, target.height / down, p.frame, 1.0)
    y = down * (rows // 2 + 2.0 * (np.arange(rows // 2) - rows // 4))[:, None]
    x = across * (columns // 2 + 2.0 * (np.arange(columns // 2) - columns // 4))[None]
    places = []
    for _ in range(BY_COLOR):
        i, j = np.unravel_index(np.argmax(contrast), contrast.shape)
        places.append(target._replace(x=float(x[0, j]), y=float(y[i, 0])))
        near = (np.abs(x - x[0, j]) < target.side) & (np.abs(y - y[i, 0]) < target.side)
        contrast = np.where(near, -np.inf, contrast)
    return places


def _lattice(state: State, image: Image, p: FusedParams) -> list[Target]:
    """The target at places half a window apart, over the whole frame."""
    half = p.context * state.target.side / 2
    height, width = image.shape[:2]
    rows, columns = (min(max(int(np.ceil(length / half)), 1), CELLS) for length in (height, width))
    return [
        state.target._replace(x=(j + 0.5) * width / columns, y=(i + 0.5) * height / rows)
        for i in range(rows)
        for j in range(columns)
    ]


def peak(values: NDArray[np.floating], index: int) -> float:
    """Offset from the largest value of the top of the parabola through it and its neighbours."""
    if not 0 < index < len(values) - 1:
        return 0.0
    before, top, after = (float(each) for each in values[index - 1 : index + 2])
    bend = before - 2 * top + after
    return 0.5 * (before - after) / bend if bend < 0 else 0.0
