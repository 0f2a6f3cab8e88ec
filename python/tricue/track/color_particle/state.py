# SPDX-License-Identifier: MIT
"""The state that the color particle tracker keeps from frame to frame."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.track.color_particle.appearance import Appearance
from tricue.track.color_particle.motion import EllipseMotion
from tricue.track.color_particle.params import ColorParticleParams

MIN_MISSED_FRAMES = 5  # consecutive, before the target is LOST


class ColorParticleSet(NamedTuple):
    """Weighted particles and their estimate.

    particles: (N, 4) ellipses x, y, minor, major, pixels. weights: (N,), which need not sum to 1.
    effective: the effective sample size. ellipse: (4,) the particles' expected value.
    log_likelihood: of that ellipse, nats. seen: the observation in its window, which is recognized and
    learned.
    """

    particles: Floats
    weights: Floats
    effective: float
    ellipse: Floats
    log_likelihood: float
    seen: Any


class FirstFrame(NamedTuple):
    """What stays as the first frame showed it.

    skin_color: (3,) the reference color of the skin classifier.
    """

    shape: tuple[int, ...]
    appearance: Appearance
    skin_color: NDArray[np.uint8]


class Confidence(NamedTuple):
    """What says whether the target is where the particles are."""

    recognition: float  # in [0, 1], by the learned appearance; decides whether to learn
    score: float  # probability that it is the target, by the first frame's appearance
    mean_log_likelihood: float  # running mean over the frames in which it was estimated
    recognized_mean: float  # the same, over the frames in which it was recognized
    lead: float  # running mean of its lead over the windows beside it, nats
    missed_frames: int = 0  # consecutive


class Clock(NamedTuple):
    """Times; seconds are of consecutive frames that are missed, or have a low lead."""

    timestamp: float | None
    frames: int = 0  # since the first
    missed_seconds: float = 0.0
    low_lead_seconds: float = 0.0


class ColorParticleState(NamedTuple):
    """Everything that changes from frame to frame; immutable, ``update`` replaces it.

    Its parts are replaced as a whole, which is faster than many fields one by one.
    """

    first: FirstFrame
    appearance: Appearance
    motion: EllipseMotion
    particles: ColorParticleSet
    confidence: Confidence
    clock: Clock

    def is_lost(self, p: ColorParticleParams) -> bool:
        """Whether the target is LOST, and is searched for in the whole frame."""
        _, _, missed_seconds, low_lead_seconds = self.clock
        missed = self.confidence.missed_frames >= MIN_MISSED_FRAMES and missed_seconds >= p.lost_after
        return missed or (low_lead_seconds > 0 and low_lead_seconds >= p.max_time_without_lead)

    def has_low_lead(self, p: ColorParticleParams) -> bool:
        """Whether the target is hardly more likely than the windows beside it."""
        return self.confidence.lead < p.min_lead

    def is_tracked(self, p: ColorParticleParams) -> bool:
        """Whether the target is TRACKED."""
        return self.confidence.missed_frames == 0 and not self.has_low_lead(p)
