# SPDX-License-Identifier: MIT
"""A step of the color particle tracker's filter (Sabeti, Parvizi, Wu 2008, section III)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats, Singles
from tricue.reference.base.checks import refuse, require_shape, require_weights
from tricue.reference.cues.color.rank_likelihood import rank_likelihood
from tricue.reference.cues.color.rank_window import rank_window
from tricue.reference.fuse.propose import propose
from tricue.reference.fuse.resample import resample
from tricue.reference.fuse.reweight import reweight
from tricue.reference.fuse.summarize import summarize

Four = tuple[float, float, float, float]

MIN_WEIGHT = 1e-300  # lower bound of a weight before its logarithm is taken


def rank_filter(
    image: NDArray[np.uint8],
    particles: Floats,
    weights: Floats,
    offset: float | None,
    noise: Floats,
    correlation: float,
    drift: Four,
    scale: Four,
    lower: Four,
    upper: Four,
    mean: tuple[float, float],
    root: tuple[float, float, float],
    share: float,
    inside: Floats,
    around: Floats,
    models: Singles,
    shares: Floats,
    nearest: bool,
    table: Singles,
    sharpness: float,
    contrast_weight: float,
    flat: float,
) -> tuple[Floats, Floats, float, Floats, float, Singles, Floats]:
    """Calls the twins of its parts, one after the other."""
    _check(particles, weights)
    log_weights = np.zeros(len(weights))
    if offset is None:
        require_weights(weights)
        log_weights = np.log(np.maximum(weights, MIN_WEIGHT))
    else:
        particles = particles[resample(weights, offset)]
    look = (inside, around, models, shares, nearest, table, sharpness, contrast_weight)
    moves, limits = (np.array(drift), np.array(scale)), (np.array(lower), np.array(upper))
    first, cross, second = root
    gaussian = np.array(mean), np.array([[first, 0.0], [cross, second]])
    moved = propose(particles, *moves, _mixed(noise, correlation), *gaussian, share, *limits)
    log_likelihood = rank_likelihood(image, moved, *look) + log_weights
    posterior, _ = reweight(log_likelihood, moved, particles, *moves, *gaussian, share)
    ellipse, _, effective = summarize(moved, posterior)
    its_own = float(rank_likelihood(image, ellipse[None], *look)[0])
    return moved, posterior, effective, ellipse, its_own, *rank_window(image, ellipse, inside, models, flat)


def _mixed(noise: Floats, correlation: float) -> Floats:
    require_shape("noise", noise, (len(noise), 4))
    if not abs(correlation) <= 1:
        refuse("correlation", "a number in [-1, 1]", float(correlation))
    mixing = np.eye(4)
    mixing[2:, 3] = correlation, np.sqrt(1 - correlation**2)
    return np.asarray(noise @ mixing)


def _check(particles: Floats, weights: Floats) -> None:
    if len(particles) < 1:
        refuse("particles", "at least one", "none")
    require_shape("particles", particles, (len(particles), 4))
    require_shape("weights", weights, (len(particles),))
