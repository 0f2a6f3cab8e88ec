# SPDX-License-Identifier: MIT
"""The low-level half of the proposal: where the skin classifier sees the target's color, section III.A."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue.kernels import Kernels
from tricue.track.base.prediction import Prediction
from tricue.track.color_particle.motion import Ellipse, Motion
from tricue.track.color_particle.params import ColorParticleParams

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]

PATCH = 1 / 3  # the middle of the target, of its width and height, gives the reference color
ENOUGH = 0.05  # of the target's area; fewer skin pixels say nothing


class Detection(NamedTuple):
    """N(mean, root rootᵀ) over the position, and the share of the particles that is drawn from it."""

    mean: Floats
    root: Floats
    share: float


NOTHING = Detection(np.zeros(2), np.eye(2), 0.0)


def reference_color(k: Kernels, image: Image, ellipse: Ellipse) -> Image:
    """(3,): the color that appears most in the middle of the target, of its pixels inside the image: (3)."""
    height, width = image.shape[:2]
    x, y, minor, major = ellipse
    left, right = np.clip([x - PATCH * minor, x + PATCH * minor], 0, width - 1).astype(int)
    top, bottom = np.clip([y - PATCH * major, y + PATCH * major], 0, height - 1).astype(int)
    return k.skin_reference(image[top : bottom + 1, left : right + 1])


def detect(
    k: Kernels,
    image: Image,
    reference: Image,
    ellipse: Ellipse,
    prediction: Prediction,
    p: ColorParticleParams,
) -> Detection:
    """The Gaussian of the skin pixels, (11)-(16), in the part of the image that the target can reach."""
    if p.skin_share == 0:
        return NOTHING
    (left, top, *_), (right, bottom, *_) = prediction.lower.tolist(), prediction.upper.tolist()
    minor, major = ellipse[2:]
    region = (int(left - minor), int(top - major), int(right + minor) + 1, int(bottom + major) + 1)
    count, x, y, xx, yy, xy = k.skin_moments(image, reference, p.skin_threshold, region).tolist()
    if count < ENOUGH * 4 * minor * major:
        return NOTHING
    # Cholesky of the covariance; a pixel's own extent keeps it positive.
    first = (xx + 1.0) ** 0.5
    cross = xy / first
    root = np.array(((first, 0.0), (cross, (yy + 1.0 - cross * cross) ** 0.5)))
    return Detection(np.array((x, y)), root, p.skin_share)


def candidates(
    k: Kernels,
    image: Image,
    reference: Image,
    motion: Motion,
    p: ColorParticleParams,
    rng: np.random.Generator,
) -> Floats:
    """(2 particles, 4): where to look for a lost target, half at blobs of its color, half anywhere.

    Blobs are drawn by their area. All have the remembered size, up to a fifth more or less.
    """
    n = p.particles
    height, width = image.shape[:2]
    size = motion.usual
    places = rng.random((2 * n, 2)) * (width, height)
    enough = min(max(1, int(ENOUGH * 4 * size[0] * size[1])), width * height)
    blobs = k.skin_blobs(image, reference, p.skin_threshold, enough)
    spread = rng.standard_normal((n, 2))
    if len(blobs):
        area = blobs[:, 4]
        chosen = blobs[k.resample(np.ascontiguousarray(area), rng.random())]
        each = chosen[np.arange(n) % len(chosen)]
        places[:n] = each[:, 5:7] + 0.25 * each[:, 2:4] * spread
    scales = np.exp(rng.uniform(-0.2, 0.2, 2 * n))
    return np.concatenate([places, np.outer(scales, size)], axis=1)
