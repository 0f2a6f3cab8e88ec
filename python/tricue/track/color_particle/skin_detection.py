# SPDX-License-Identifier: MIT
"""Skin detection, section III.A: the low-level half of the proposal, and the candidates of a re-detection."""

from typing import NamedTuple

import numpy as np

from tricue.arrays import Floats, Image
from tricue.kernels import Kernels
from tricue.track.color_particle.motion import Ellipse, EllipseMotion, EllipsePrediction
from tricue.track.color_particle.params import ColorParticleParams

SKIN_PATCH = 1 / 3  # of the target's width and height: the central patch that gives its reference color
MIN_SKIN_AREA = 0.05  # of the target's area; with fewer skin pixels there is no detection
SKIN_ROWS = 128  # up to twice this many are read where the target can be next; of more, every n-th suffices
MIN_PIXEL_VARIANCE = 1.0  # pixels², added to keep the covariance positive definite
BLOB_SPREAD = 0.25  # standard deviation of candidates at a blob, as a share of its width and height
CANDIDATE_SCALE = 0.2  # candidates have the mean size times exp of up to plus or minus this


class SkinDetection(NamedTuple):
    """The Gaussian N(mean, root rootᵀ) over the position, and the share of the particles drawn from it.

    root: its lower triangle, row by row.
    """

    mean: tuple[float, float]
    root: tuple[float, float, float]
    share: float

    def arrays(self) -> tuple[Floats, Floats, float]:
        """mean (2,), root (2, 2) and share."""
        first, cross, second = self.root
        return np.array(self.mean), np.array([[first, 0.0], [cross, second]]), self.share


NO_DETECTION = SkinDetection((0.0, 0.0), (1.0, 0.0, 1.0), 0.0)


def reference_color(k: Kernels, image: Image, ellipse: Ellipse) -> Image:
    """(3,) the most frequent color in the central patch of the target: (3)."""
    height, width = image.shape[:2]
    x, y, minor, major = ellipse
    left, right = np.clip([x - SKIN_PATCH * minor, x + SKIN_PATCH * minor], 0, width - 1).astype(int)
    top, bottom = np.clip([y - SKIN_PATCH * major, y + SKIN_PATCH * major], 0, height - 1).astype(int)
    return k.skin_reference(image[top : bottom + 1, left : right + 1])


def detect_skin(
    k: Kernels,
    image: Image,
    skin_color: Image,
    ellipse: Ellipse,
    prediction: EllipsePrediction,
    p: ColorParticleParams,
) -> SkinDetection:
    """The Gaussian of the skin pixels, (11)-(16), where the target can be next, or in the whole image."""
    if p.skin_share == 0:
        return NO_DETECTION
    (minor, major), step = ellipse[2:], 1
    if p.skin_region == "image":
        region = (0, 0, image.shape[1], image.shape[0])
    else:
        left, top, _, _ = prediction.lower
        right, bottom, _, _ = prediction.upper
        region = (int(left - minor), int(top - major), int(right + minor) + 1, int(bottom + major) + 1)
        step = max((region[3] - region[1]) // SKIN_ROWS, 1)
    count, x, y, xx, yy, xy = k.skin_moments(image, skin_color, p.skin_threshold, region, step).tolist()
    if count < MIN_SKIN_AREA * 4 * minor * major:
        return NO_DETECTION
    # Cholesky decomposition of the covariance.
    first = (xx + MIN_PIXEL_VARIANCE) ** 0.5
    cross = xy / first
    second = (yy + MIN_PIXEL_VARIANCE - cross * cross) ** 0.5
    return SkinDetection((x, y), (first, cross, second), p.skin_share)


def draw_candidates(
    k: Kernels,
    image: Image,
    skin_color: Image,
    motion: EllipseMotion,
    p: ColorParticleParams,
    rng: np.random.Generator,
) -> Floats:
    """Ellipses (2 * particles, 4) at which to search for a lost target.

    Half of them are at blobs of the skin color, which are drawn in proportion to their area. The others are
    uniform over the image. All have the target's mean size, changed by a random factor.
    """
    n = p.particles
    height, width = image.shape[:2]
    size = motion.mean_size
    centers = rng.random((2 * n, 2)) * (width, height)
    min_area = min(max(1, int(MIN_SKIN_AREA * 4 * size[0] * size[1])), width * height)
    blobs = k.skin_blobs(image, skin_color, p.skin_threshold, min_area)
    noise = rng.standard_normal((n, 2))
    if len(blobs):
        area = blobs[:, 4]
        drawn = blobs[k.resample(np.ascontiguousarray(area), rng.random())]
        each = drawn[np.arange(n) % len(drawn)]
        centers[:n] = each[:, 5:7] + BLOB_SPREAD * each[:, 2:4] * noise
    factors = np.exp(rng.uniform(-CANDIDATE_SCALE, CANDIDATE_SCALE, 2 * n))
    return np.concatenate([centers, np.outer(factors, size)], axis=1)
