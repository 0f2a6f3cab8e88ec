# SPDX-License-Identifier: MIT
"""Where the head is in a view: the ellipse most like the model, Moreno et al. 2002, section 3.1."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.stereo_head.params import StereoHeadParams
from tricue.track.stereo_head.view import Ellipse, View

Floats = NDArray[np.float64]
NO_BIN = np.uint16(65535)
CAP = 0.3  # of the head's height
LEAST = 8  # pixels at the head's depth; with fewer all count


class Place(NamedTuple):
    """An ellipse, its score, its intersection (1) with the model, and the share of it at the head's depth."""

    ellipse: Ellipse
    score: float
    intersection: float
    coherence: float


def best_place(
    k: Kernels,
    view: View,
    ellipse: Ellipse,
    histogram: Floats,
    step: int,
    search: tuple[int, int],
    p: StereoHeadParams,
) -> Place:
    """The best of the places round an ellipse, at most ``search`` away to each side, and up and down."""
    across, down = search
    grid = (2 * down + 1, 2 * across + 1, 1)
    measured = k.ellipse_search(
        view.bins, in_places(ellipse, view, step), grid, histogram, p.ring, view.coherent
    )
    scores = score(measured, p)
    row, column = divmod(int(np.argmax(scores)), grid[1])
    x, y, minor, major = ellipse
    there = (x + step * (column - across), y + step * (row - down), minor, major)
    intersection, _, coherence, _ = measured[row, column].tolist()
    return Place(there, float(scores[row, column]), intersection, coherence)


def score(measured: Floats, p: StereoHeadParams) -> Floats:
    """(...,) of intersections and coherent shares (..., 4), each of an ellipse and of the ring round it."""
    color, around, coherent, behind = np.moveaxis(measured, -1, 0)
    depth = coherent - p.depth_ring * behind
    return np.asarray(color - p.ring_weight * around + p.depth_weight * depth)


def in_places(ellipse: Ellipse, view: View, step: int) -> Floats:
    """(4,) in places of the view."""
    x, y, minor, major = ellipse
    return np.array([x / step - view.left, y / step - view.top, minor / step, major / step])


def histogram_of(k: Kernels, view: View, ellipse: Ellipse, step: int, p: StereoHeadParams) -> Floats:
    """(L,) of sum 1, C of (2): of the pixels in an ellipse, or of those of them at the head's depth."""
    bins = view.bins
    if p.learn == "coherent":
        bins = np.where(view.coherent, bins, NO_BIN)
    counts = _count(k, bins, ellipse, view, step, p)
    if counts.sum() < LEAST:
        counts = _count(k, view.bins, ellipse, view, step, p)
    return np.asarray(counts / max(counts.sum(), 1.0))


def first_histogram(k: Kernels, view: View, ellipse: Ellipse, step: int, p: StereoHeadParams) -> Floats:
    """(L,) of sum 1: skin and hair, so that a head is still one from behind; hair is what is on top."""
    x, y, minor, major = ellipse
    cap = (x, y - (1 - CAP) * major, minor, CAP * major)
    whole, hair = (histogram_of(k, view, each, step, p) for each in (ellipse, cap))
    return (1 - p.hair) * whole + p.hair * hair


def _count(
    k: Kernels, bins: NDArray[np.uint16], ellipse: Ellipse, view: View, step: int, p: StereoHeadParams
) -> Floats:
    size = p.bins[0] * p.bins[1] * p.bins[2]
    inside, _ = k.ellipse_histogram(bins, in_places(ellipse, view, step)[None], size, 1.0)
    counts: Floats = inside[0].astype(np.float64)
    return counts
