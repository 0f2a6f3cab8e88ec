# SPDX-License-Identifier: MIT
"""Section III, written down from the paper and from what Params.paper() says that it takes where print is
silent, beside the tracker: the same random numbers give the same particles.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from tricue import ColorParticleTracker
from tricue.track.base.noise_pool import NoisePool
from tricue.track.color_particle.tracker import STEPS_PER_FRAME

PAPER = ColorParticleTracker.Params.paper()
N = 100  # particles, section V
SECTIONS = 16  # N of (19)
ROWS, COLUMNS = 64, 48  # of the window's grid
SHARE = 0.5  # of the particles, from the skin's Gaussian

Array = NDArray[np.float64]


class Proposal(NamedTuple):
    """What the particles are drawn from: noise, bounds, and the mean and covariance of the skin, if any."""

    noise: Array
    lower: Array
    upper: Array
    skin: tuple[Array, Array] | None


def window(image: NDArray[np.uint8], ellipse: Array) -> NDArray[np.uint8]:
    """(n, 3) the pixels in an ellipse, those outside the image at its border."""
    x, y, minor, major = ellipse
    v, u = np.meshgrid(*((2 * np.arange(n) + 1) / n - 1 for n in (ROWS, COLUMNS)), indexing="ij")
    inside = u**2 + v**2 <= 1
    columns = np.floor(x + minor * u[inside]).astype(int).clip(0, image.shape[1] - 1)
    rows = np.floor(y + major * v[inside]).astype(int).clip(0, image.shape[0] - 1)
    return image[rows, columns]


def sections(image: NDArray[np.uint8], ellipse: Array) -> Array:
    """(17), (19)-(28), each channel divided by its sum."""
    a = np.empty((3, SECTIONS))
    for k, levels in enumerate(window(image, ellipse).T):
        histogram = np.array([np.count_nonzero(levels == level) for level in range(256)])
        up_to = histogram.cumsum()  # r of (17), times the number of pixels
        # |r - zeta| of (21), times that number and SECTIONS: whole numbers, so that ties are exact
        q = [up_to[np.argmin(abs(SECTIONS * up_to - n * levels.size))] for n in range(SECTIONS + 1)]
        for n in range(SECTIONS):
            a[k, n] = sum(rank for rank in up_to.tolist() if q[n] <= rank <= q[n + 1])
    return a / a.sum(axis=1, keepdims=True)


def likelihood(image: NDArray[np.uint8], ellipse: Array, model: Array) -> float:
    """(18) with (29) over its maximum."""
    difference = sections(image, ellipse) - model
    return 1 - sum(np.linalg.norm(channel) for channel in difference) / (3 * np.sqrt(2))


def most_frequent(image: NDArray[np.uint8], ellipse: Array) -> Array:
    """(3): the mean of the fullest of 32 x 32 x 32 cells, in the middle third of the box."""
    x, y, minor, major = ellipse
    left, right, top, bottom = map(int, (x - minor / 3, x + minor / 3, y - major / 3, y + major / 3))
    colors = image[top : bottom + 1, left : right + 1].reshape(-1, 3)
    cells, counts = np.unique(colors // 8, axis=0, return_counts=True)
    return np.floor(colors[(colors // 8 == cells[counts.argmax()]).all(axis=1)].mean(axis=0) + 0.5)


def skin_gaussian(image: NDArray[np.uint8], color: Array, ellipse: Array) -> tuple[Array, Array] | None:
    """(5)-(16): the mean and covariance of the skin pixels' centers; None where there are few."""
    normalized, reference = image / 255, color / 255
    boundary = normalized.max(axis=2) - abs(normalized - reference).max(axis=2)
    y, x = np.nonzero(boundary > PAPER.skin_threshold)
    if len(x) < 0.05 * 4 * ellipse[2] * ellipse[3]:
        return None
    return np.array([x.mean(), y.mean()]) + 0.5, np.cov(x, y, bias=True) + np.eye(2)


def draw(before: Array, proposal: Proposal, white: Array) -> tuple[Array, Array]:
    """The particles, and p / q of (2)."""
    noise, lower, upper, skin = proposal
    drawn = before + noise * white
    if skin is None:
        return drawn.clip(lower, upper), np.ones(N)
    mean, covariance = skin
    drawn[1::2, :2] = mean + white[1::2, :2] @ np.linalg.cholesky(covariance).T
    drawn = drawn.clip(lower, upper)
    p = density(drawn[:, :2] - before[:, :2], np.diag(noise[:2] ** 2))
    return drawn, p / (SHARE * density(drawn[:, :2] - mean, covariance) + (1 - SHARE) * p)


def density(offsets: Array, covariance: Array) -> Array:
    """Of a Gaussian."""
    exponent = (offsets @ np.linalg.inv(covariance) * offsets).sum(axis=1) / 2
    return np.asarray(np.exp(-exponent) / (2 * np.pi * np.sqrt(np.linalg.det(covariance))))


def test_a_script_of_section_iii_draws_the_same_particles(scene):
    """Through six frames, in which half of the particles come from the skin's Gaussian."""
    images = [frame.color for frame in scene.frames[:6]]
    tracker = ColorParticleTracker(params=PAPER, seed=5)
    tracker.init(images[0], scene.boxes[0])
    numbers = NoisePool(5, 4 * N)
    first = estimate = np.array(scene.boxes[0].ellipse)
    particles, weights, velocity = np.repeat(first[None], N, axis=0), np.full(N, 1 / N), np.zeros(2)
    model, color = sections(images[0], first), most_frequent(images[0], first)
    height, width = images[0].shape[:2]
    for number, image in enumerate(images[1:]):
        track = tracker.update(image)
        if number > 0:  # the first frame's particles are all the same
            points = (np.arange(N) + numbers.uniform(STEPS_PER_FRAME * number)) / N
            particles = particles[np.searchsorted(weights.cumsum(), points, side="right")]
        side = 2 * np.sqrt(estimate[2] * estimate[3])
        noise = np.array([*(0.5 + 0.05 * side + abs(velocity)), *(0.02 * estimate[2:])])  # (30)
        skin = skin_gaussian(image, color, estimate)
        assert skin is not None
        lower = [*np.maximum(estimate[:2] - 40, 0), *(0.01 * first[2:])]
        upper = [*np.minimum(estimate[:2] + 40, (width, height)), *(100 * first[2:])]
        proposal = Proposal(noise, np.array(lower), np.array(upper), skin)
        particles, ratio = draw(particles, proposal, numbers.normal(STEPS_PER_FRAME * number, (N, 4)))
        weights = np.array([likelihood(image, each, model) for each in particles]) * ratio  # (2)
        weights /= weights.sum()  # (31)
        velocity, estimate = (weights @ particles - estimate)[:2], weights @ particles
        # The kernel rounds sections to float32, 6e-8; particles at 300 px differ by more as frames go by.
        np.testing.assert_allclose(tracker.particles, particles, atol=1e-5)
        np.testing.assert_allclose(track.box.ellipse, estimate, atol=1e-5)
        assert likelihood(image, estimate, model) > 1 - 0.7 * 0.3  # so confident that it is learned
        model = sections(image, estimate)
