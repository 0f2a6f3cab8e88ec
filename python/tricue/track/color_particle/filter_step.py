# SPDX-License-Identifier: MIT
"""One step of the particle filter, section III: resample, propose (30), weigh by (2) and (31), estimate."""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats, Image
from tricue.kernels import Kernels
from tricue.track.color_particle.appearance import Appearance
from tricue.track.color_particle.motion import EllipsePrediction
from tricue.track.color_particle.rank_models import MIN_RANK_SPREAD, RankWindow
from tricue.track.color_particle.skin_detection import NO_DETECTION, SkinDetection
from tricue.track.color_particle.state import ColorParticleSet

MIN_WEIGHT = 1e-300  # of a particle, to take the logarithm


class StepNoise(NamedTuple):
    """The random numbers of one step.

    offset: of the systematic resampling's comb; None for no resampling. white: (N, 4) independent standard
    normal numbers. correlation: to give those of the two semi-axes.
    """

    offset: float | None
    white: Floats
    correlation: float


class Proposal(NamedTuple):
    """Where the particles of one step are drawn from, (30): the motion, and a share from the detection."""

    prediction: EllipsePrediction
    detection: SkinDetection = NO_DETECTION


def filter_step(
    k: Kernels,
    image: Image,
    appearance: Appearance,
    particles: Floats,
    weights: Floats,
    noise: StepNoise,
    proposal: Proposal,
    searching: bool,
) -> ColorParticleSet:
    """The particles (N, 4) of the next frame; a single kernel does it all if it supports the likelihood.

    searching: whether for a lost target.
    """
    prediction, detection = proposal
    arguments = appearance.rank_arguments(searching)
    if arguments is not None:
        step = k.rank_filter(
            image,
            (particles, weights, noise.offset),
            (noise.white, noise.correlation),
            prediction[:2],
            prediction[2:],
            detection,
            *arguments,
            MIN_RANK_SPREAD,
        )
        return ColorParticleSet(*step[:5], RankWindow(*step[5:]))
    log_weights = np.zeros(len(weights))
    if noise.offset is None:
        log_weights = np.log(np.maximum(weights, MIN_WEIGHT))
    else:
        particles = particles.take(k.resample(weights, noise.offset), axis=0)
    drift, scale, lower, upper = map(np.array, prediction)
    dynamics, detected = (drift, scale), detection.arrays()
    draws = mix_sizes(noise.white, noise.correlation)
    moved = k.propose(particles, dynamics, draws, detected, (lower, upper))
    log_likelihood = appearance.log_likelihood(k, image, moved, searching) + log_weights
    posterior, _ = k.reweight(log_likelihood, moved, particles, dynamics, detected)
    ellipse, _, effective = k.summarize(moved, posterior)
    estimated = float(appearance.log_likelihood(k, image, ellipse[None], searching)[0])
    return ColorParticleSet(
        moved, posterior, effective, ellipse, estimated, appearance.observe(k, image, ellipse)
    )


def mix_sizes(noise: Floats, correlation: float) -> Floats:
    """White noise (N, 4) with its last two columns correlated."""
    mixing = np.eye(4)
    mixing[2, 3], mixing[3, 3] = correlation, (1 - correlation**2) ** 0.5
    return np.asarray(noise @ mixing)
