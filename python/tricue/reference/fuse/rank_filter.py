# SPDX-License-Identifier: MIT
"""A step of the color particle tracker's filter (Sabeti, Parvizi, Wu 2008, section III)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Floats, Singles
from tricue.reference.base.checks import refuse, require_shape, require_weights
from tricue.reference.cues.color.rank_likelihood import (
    ColorAppearance,
    Factors,
    Pattern,
    rank_likelihood,
)
from tricue.reference.cues.color.rank_window import rank_window
from tricue.reference.fuse.propose import propose
from tricue.reference.fuse.resample import resample
from tricue.reference.fuse.reweight import reweight
from tricue.reference.fuse.summarize import summarize

Four = tuple[float, float, float, float]

MIN_WEIGHT = 1e-300  # lower bound of a weight before its logarithm is taken


def rank_filter(
    image: NDArray[np.uint8],
    last: tuple[Floats, Floats, float | None],
    noise: tuple[Floats, float],
    dynamics: tuple[Four, Four],
    bounds: tuple[Four, Four],
    detection: tuple[tuple[float, float], tuple[float, float, float], float],
    pattern: Pattern,
    appearance: ColorAppearance,
    factors: Factors,
    flat: float,
) -> tuple[Floats, Floats, float, Floats, float, Singles, Floats]:
    """Calls the twins of its parts, one after the other."""
    particles, weights, offset = last
    _check(particles, weights)
    log_weights = np.zeros(len(weights))
    if offset is None:
        require_weights(weights)
        log_weights = np.log(np.maximum(weights, MIN_WEIGHT))
    else:
        particles = particles[resample(weights, offset)]
    (drift, scale), (lower, upper) = map(np.array, dynamics), map(np.array, bounds)
    mean, (first, cross, second), share = detection
    gaussian = np.array(mean), np.array([[first, 0.0], [cross, second]]), share
    motion = drift, scale
    moved = propose(particles, motion, _mixed(*noise, len(particles)), gaussian, (lower, upper))
    log_likelihood = rank_likelihood(image, moved, pattern, appearance, factors) + log_weights
    posterior, _ = reweight(log_likelihood, moved, particles, motion, gaussian)
    ellipse, _, effective = summarize(moved, posterior)
    its_own = float(rank_likelihood(image, ellipse[None], pattern, appearance, factors)[0])
    window = rank_window(image, ellipse, pattern[0], appearance[0], flat)
    return moved, posterior, effective, ellipse, its_own, *window


def _mixed(white: Floats, correlation: float, count: int) -> Floats:
    require_shape("white", white, (count, 4))
    if not abs(correlation) <= 1:
        refuse("correlation", "a number in [-1, 1]", float(correlation))
    mixing = np.eye(4)
    mixing[2:, 3] = correlation, np.sqrt(1 - correlation**2)
    return np.asarray(white @ mixing)


def _check(particles: Floats, weights: Floats) -> None:
    if len(particles) < 1:
        refuse("particles", "at least one", "none")
    require_shape("particles", particles, (len(particles), 4))
    require_shape("weights", weights, (len(particles),))
