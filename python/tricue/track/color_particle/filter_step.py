# SPDX-License-Identifier: MIT
"""One step of the particle filter, section III: propose (30), weigh (2), estimate (31)."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.base.prediction import Prediction
from tricue.track.color_particle.appearance import Appearance
from tricue.track.color_particle.skin_detection import SkinDetection
from tricue.track.color_particle.state import ParticleSet

Floats = NDArray[Any]


def filter_step(
    k: Kernels,
    image: NDArray[np.uint8],
    appearance: Appearance,
    particles: Floats,
    log_weights: Floats,
    noise: Floats,
    prediction: Prediction,
    detection: SkinDetection,
    searching: bool,
) -> ParticleSet:
    """The particles (N, 4) of the next frame. One kernel does it all where it knows the likelihood.

    log_weights: (N,) of the particles, but for a constant. noise: (N, 4) independent standard normal numbers.
    searching: for a lost target.
    """
    look = appearance.rank_look(searching)
    if look is not None:
        step = k.rank_filter(image, particles, log_weights, noise, *prediction, *detection, *look)
        return ParticleSet(*step)
    drift, scale, lower, upper = prediction
    moved = k.propose(particles, drift, scale, noise, *detection, lower, upper)
    log_likelihood = appearance.log_likelihood(k, image, moved, searching) + log_weights
    weights, _ = k.reweight(log_likelihood, moved, particles, drift, scale, *detection)
    ellipse, _, effective = k.summarize(moved, weights)
    estimated = float(appearance.log_likelihood(k, image, ellipse[None], searching)[0])
    return ParticleSet(moved, weights, effective, ellipse, estimated)
