# SPDX-License-Identifier: MIT
"""One step of the color tracker's particle filter (Sabeti, Parvizi, Wu 2008, section III)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.checks import refuse, require_shape
from tricue.reference.cues.color.rank_likelihood import rank_likelihood
from tricue.reference.fuse.propose import propose
from tricue.reference.fuse.reweight import reweight
from tricue.reference.fuse.summarize import summarize

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]


def rank_filter(
    image: NDArray[np.uint8],
    particles: Floats,
    log_weights: Floats,
    noise: Floats,
    drift: Floats,
    scale: Floats,
    lower: Floats,
    upper: Floats,
    mean: Floats,
    root: Floats,
    share: float,
    inside: Floats,
    around: Floats,
    models: Singles,
    shares: Floats,
    nearest: bool,
    table: Singles,
    sharpness: float,
    contrast_weight: float,
) -> tuple[Floats, Floats, float, Floats, float]:
    """Calls the twins of the kernels that it joins, one after the other."""
    _check(particles, log_weights)
    look = (inside, around, models, shares, nearest, table, sharpness, contrast_weight)
    moved = propose(particles, drift, scale, noise, mean, root, share, lower, upper)
    log_likelihood = rank_likelihood(image, moved, *look) + log_weights
    weights, _ = reweight(log_likelihood, moved, particles, drift, scale, mean, root, share)
    ellipse, _, effective = summarize(moved, weights)
    its_own = float(rank_likelihood(image, ellipse[None], *look)[0])
    return moved, weights, effective, ellipse, its_own


def _check(particles: Floats, log_weights: Floats) -> None:
    if len(particles) < 1:
        refuse("particles", "at least one", "none")
    require_shape("particles", particles, (len(particles), 4))
    require_shape("log_weights", log_weights, (len(particles),))
    strange = log_weights[~(log_weights <= 0)]
    if strange.size:
        refuse("log_weights", "numbers up to 0", float(strange[0]))
