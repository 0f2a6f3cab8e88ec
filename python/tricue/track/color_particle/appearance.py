# SPDX-License-Identifier: MIT
"""The target's appearance: the likelihood that a window of the image shows it, and how it is learned."""

import math
from typing import Any, NamedTuple

import numpy as np

from tricue.arrays import Floats, Image, Singles
from tricue.kernels import Kernels
from tricue.track.base.ellipse_pattern import EllipsePattern, ring
from tricue.track.color_particle.color_contrast import ColorContrast
from tricue.track.color_particle.color_models import Gaussian, Histogram, Lookup, Region
from tricue.track.color_particle.observation_model import ObservationModel, WindowSamples, window_grid
from tricue.track.color_particle.params import ColorParticleParams
from tricue.track.color_particle.rank_models import RankSections, RankSpatial

OBSERVATION_MODELS: dict[str, type[Any]] = {
    "region": Region,
    "gaussian": Gaussian,
    "lookup": Lookup,
    "histogram": Histogram,
    "rank-sections": RankSections,
    "rank-spatial": RankSpatial,
}
MIN_LINEAR_LIKELIHOOD = 1e-12  # in its logarithm
LOG_ODDS, PER_NAT, PER_NAT_OF_LEAD = -0.11, 0.0275, 0.0945  # fitted on the 30 recorded color sequences
MAX_LEAD = 60.0  # nats; a larger lead doesn't add to the probability
MAX_LOG_ODDS = 50.0  # beyond this a probability no longer changes
STEP_BESIDE = 1.5  # semi-axes: windows beside the target overlap it by one seventh (IoU)


def _pattern_beside() -> Floats:
    """(4, 16): an ellipse (4,) times it gives the windows to its left, right, above and below."""
    step = STEP_BESIDE
    linear = np.tile(np.eye(4), (4, 1, 1))
    linear[range(4), [2, 2, 3, 3], [0, 0, 1, 1]] = [-step, step, -step, step]
    return np.ascontiguousarray(linear.transpose(1, 0, 2)).reshape(4, 16)


BESIDE = _pattern_beside()


class ColorAppearance(NamedTuple):
    """What the target looks like, for the kernels: its rank maps and their weights, and its colors."""

    maps: Singles
    weights: Floats
    nearest: bool  # whether the most similar of the maps counts alone
    table: Singles


RankArguments = tuple[EllipsePattern, ColorAppearance, tuple[float, float]]
"""What ``rank_likelihood``, ``rank_search`` and ``rank_filter`` measure windows by, as their arguments.

The factors in the log-likelihood, nats, are those of the squared distance of ranks and of the color contrast.
"""


class Appearance(NamedTuple):
    """The observation model and the color contrast, which are learned together."""

    model: ObservationModel
    contrast: ColorContrast | None
    pattern: EllipsePattern  # where the window and its surround are sampled
    linear: bool  # whether the likelihood is the printed (18)
    sharpness: float
    target: ColorAppearance | None  # for kernels that measure windows; None if they don't support the models

    @classmethod
    def create(cls, p: ColorParticleParams) -> "Appearance":
        """Models that have learned nothing yet."""
        model: ObservationModel = OBSERVATION_MODELS[p.observation].create(p)
        return cls.of(
            model,
            ColorContrast(p.color_weight) if p.color_weight > 0 else None,
            EllipsePattern(window_grid(p), ring(p.ring_samples, *p.ring)),
            p.likelihood == "linear",
            model.sharpness if p.sharpness is None else p.sharpness,
        )

    @classmethod
    def of(
        cls,
        model: ObservationModel,
        contrast: ColorContrast | None,
        pattern: EllipsePattern,
        linear: bool,
        sharpness: float,
    ) -> "Appearance":
        """These models, also as kernels take them, if they do."""
        target = None
        if contrast is not None and not linear and isinstance(model, RankSpatial):
            target = ColorAppearance(model.maps, model.weights, False, contrast.table)
        return cls(model, contrast, pattern, linear, sharpness, target)

    def sample(self, k: Kernels, image: Image, ellipses: Floats) -> WindowSamples:
        """Sample the windows of ellipses (N, 4)."""
        return WindowSamples(*(k.sample_ellipses(image, ellipses, places) for places in self.pattern))

    def observe(self, k: Kernels, image: Image, ellipse: Floats) -> Any:
        """What the model learns and recognizes in the window of an ellipse (4,)."""
        if isinstance(self.model, RankSpatial):
            return self.model.observe(k, image, ellipse, self.pattern.inside)
        return self.sample(k, image, ellipse[None])

    @property
    def comparable(self) -> bool:
        """Whether log-likelihoods come from color ranks and contrast, for which thresholds are known."""
        return self.target is not None

    def rank_arguments(self, searching: bool = False) -> RankArguments | None:
        """For kernels that measure windows; searching: for a lost target, by the most similar map alone."""
        if self.target is None or self.contrast is None:
            return None
        target = self.target._replace(nearest=True) if searching else self.target
        return self.pattern, target, (self.sharpness, self.contrast.weight)

    def log_likelihood(self, k: Kernels, image: Image, ellipses: Floats, searching: bool = False) -> Floats:
        """(N,) log p(y | x), nats: equation (18), or its exponential form, times the color contrast term."""
        arguments = self.rank_arguments(searching)
        if arguments is not None:
            return k.rank_likelihood(image, ellipses, *arguments)
        samples = self.sample(k, image, ellipses)
        distance = self.model.distance(k, *samples, searching).astype(np.float64)
        if self.linear:
            log_likelihood: Floats = np.log(np.maximum(1 - distance, MIN_LINEAR_LIKELIHOOD))
        else:
            log_likelihood = -self.sharpness * distance * distance
        if self.contrast:
            log_likelihood += self.contrast.log_likelihood(k, *samples)
        return log_likelihood

    def best_near(
        self, k: Kernels, image: Image, ellipse: Floats, offsets: Floats
    ) -> tuple[Floats, float, float]:
        """The most likely (4,) of an ellipse (4,) and the windows at offsets (n, 4) from it, its
        log-likelihood, and that of the ellipse; for comparable likelihoods only.
        """
        arguments = self.rank_arguments()
        assert arguments is not None
        return k.rank_search(image, ellipse, offsets, *arguments)

    def recognition(self, k: Kernels, seen: Any, searching: bool = False) -> float:
        """The similarity, in [0, 1], of the observation to the target; about 0 in noise and flat windows."""
        return self.model.recognition(k, seen, searching)

    def lead(self, k: Kernels, image: Image, ellipse: Floats, log_likelihood: float) -> float:
        """How far the log-likelihood of an ellipse (4,) is above the best of the four windows beside it,
        nats.

        A target differs from its surround; background learned by mistake seldom does. Only windows with their
        center in the image count.
        """
        beside = self.log_likelihood(k, image, (ellipse @ BESIDE).reshape(4, 4)).tolist()
        x, y, minor, major = ellipse.tolist()
        across, down = STEP_BESIDE * minor, STEP_BESIDE * major
        height, width = image.shape[:2]
        if x < across or y < down or x + across > width or y + down > height:
            inside = x >= across, x + across <= width, y >= down, y + down <= height
            beside = [each for each, is_in in zip(beside, inside, strict=True) if is_in]
        return min(log_likelihood - max(beside, default=-MAX_LEAD), MAX_LEAD)

    def learn(
        self, k: Kernels, image: Image, ellipse: Floats, seen: Any, rate: float, color_rate: float
    ) -> "Appearance":
        """Blend the window of an ellipse (4,) into both models; rates of 1 initialize them."""
        contrast = self.contrast and self.contrast.learn(k, image, ellipse, color_rate)
        model = self.model.learn(k, seen, rate)
        return Appearance.of(model, contrast, self.pattern, self.linear, self.sharpness)


def probability(log_likelihood: float, lead: float) -> float:
    """The probability that a window shows the target, by logistic regression on its log-likelihood under the
    first frame's appearance and on its mean lead, both from color ranks and contrast, nats.
    """
    log_odds = LOG_ODDS + PER_NAT * log_likelihood + PER_NAT_OF_LEAD * lead
    return 1 / (1 + math.exp(-min(max(log_odds, -MAX_LOG_ODDS), MAX_LOG_ODDS)))
