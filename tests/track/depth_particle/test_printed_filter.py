# SPDX-License-Identifier: MIT
"""Section IV, written down from the paper and from what Params.paper() says that it takes where print is
silent, beside the tracker: the same random numbers give the same objects and particles.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d
from tricue import Box, DepthParticleTracker, Frame, Intrinsics
from tricue.track.base.noise_pool import NoisePool

PAPER = DepthParticleTracker.Params.paper()
N, LEVELS, NEAR, FAR = 100, 256, 0.3, 7.5  # sections V and IV.B
SHARE, OBJECT_DEVIATION = 0.4, np.array([0.05, 0.06, 0.06, 0.06, 0.08])
FROM_OBJECT = np.diff(np.floor(np.arange(N + 1) * SHARE)) > 0
CAMERA = Intrinsics.from_fov(176, 144, 47.5, 39.5)
FX, FY, CX, CY = CAMERA.vector
SECONDS = 1 / 15
BODY, WALL, STEP = 3.0, 5.5, (0.04, 0.03)  # meters; of X and Z per frame

Array = NDArray[np.float64]
Depth = NDArray[np.float32]


class Body(NamedTuple):
    """The true rectangle, pixels, of a body in front of a wall; it stands on nothing."""

    frame: Frame
    box: Box


@pytest.fixture(scope="module")
def bodies() -> list[Body]:
    """Somebody in the air walks to the right and away; a camera with 2 cm of noise sees no floor."""
    rng, found = np.random.default_rng(0), []
    y, x = np.indices((144, 176))
    for index in range(7):
        center, z = -0.3 + STEP[0] * index, BODY + STEP[1] * index
        left, top = (round(c + f * at / z) for c, f, at in ((CX, FX, center - 0.25), (CY, FY, -0.85)))
        right, bottom = (round(c + f * at / z) for c, f, at in ((CX, FX, center + 0.25), (CY, FY, 0.85)))
        head = (y < top + 20) & (abs(x - (left + right - 1) / 2) < 6)
        body = (x >= left) & (x < right) & (y >= top) & (y < bottom) & (head | (y >= top + 20))
        depth = np.where(body, z, WALL) + rng.normal(0, 0.02, body.shape)
        frame = Frame(depth=depth.astype(np.float32), timestamp=SECONDS * index)
        found.append(Body(frame, Box(left, top, right - left, bottom - top)))
    return found


def dividers(depth: Depth) -> Array:
    """(32)-(35), with a Gaussian kernel on the histogram, cut at four standard deviations."""
    level = (FAR - NEAR) / LEVELS
    counts, _ = np.histogram(depth, LEVELS, (NEAR, FAR))
    deviation = PAPER.bandwidth / level
    p = gaussian_filter1d(counts.astype(float), deviation, radius=int(np.ceil(4 * deviation)))
    higher = np.diff(p, prepend=0) > 0, np.diff(p, append=0) < 0
    maxima = np.flatnonzero(higher[0] & higher[1])  # (32)
    minima = [a + 1 + int(p[a + 1 : b].argmin()) for a, b in pairwise(maxima)]
    return np.array([NEAR, *(NEAR + level * (np.array(minima) + 0.5)), FAR])  # (35)


def measured_object(depth: Depth) -> Array:
    """(5,) of the only candidate: the nearest division (36), which here is connected, at its mean depth."""
    first, second = dividers(depth)[:2]
    y, x = np.nonzero((first <= depth) & (depth < second))
    z = depth[y, x].astype(float).mean()
    middle = (x.min() + x.max()) / 2 - CX, (y.min() + y.max()) / 2 - CY
    size = np.ptp(x) + 1, np.ptp(y) + 1
    return np.array([middle[0] * z / FX, middle[1] * z / FY, z, size[0] * z / FX, size[1] * z / FY])


def histogram(depth: Depth, state: Array) -> Array:
    """H of (38), of 64 x 64 places in a rectangle, divided by its sum."""
    x, y, z, width, height = state
    v, u = np.meshgrid((2 * np.arange(64) + 1) / 64 - 1, (2 * np.arange(64) + 1) / 64 - 1, indexing="ij")
    columns = np.floor(CX + 0.5 + FX * (x + width / 2 * u) / z).astype(int)
    rows = np.floor(CY + 0.5 + FY * (y + height / 2 * v) / z).astype(int)
    inside = (columns >= 0) & (columns < 176) & (rows >= 0) & (rows < 144)
    depths = depth[rows[inside], columns[inside]].astype(float)
    counts = np.bincount(np.floor((depths - NEAR) * (LEVELS / (FAR - NEAR))).astype(int), minlength=LEVELS)
    return counts / counts.sum()


def likelihood(depth: Depth, state: Array, model: Array) -> float:
    """(37), with (38) over its maximum."""
    return float(1 - np.linalg.norm(histogram(depth, state) - model) / np.sqrt(2))


def draw(before: Array, deviation: Array, target: Array, white: Array) -> tuple[Array, Array]:
    """The particles, 40 of them at the object, and p / q of (2)."""
    drawn = before + deviation * white
    drawn[FROM_OBJECT] = target + OBJECT_DEVIATION * white[FROM_OBJECT]
    p, at_object = (
        np.exp(-0.5 * (((drawn - mean) / scale) ** 2).sum(axis=1)) / scale.prod()
        for mean, scale in ((before, deviation), (target, OBJECT_DEVIATION))
    )
    return drawn, p / (SHARE * at_object + (1 - SHARE) * p)


def test_a_script_of_section_iv_draws_the_same_particles(bodies):
    """Through six frames, in each of which 40 of the particles are drawn at the segmented object."""
    tracker = DepthParticleTracker(params=PAPER, intrinsics=CAMERA, seed=5)
    tracker.init(bodies[0].frame, bodies[0].box)
    numbers = NoisePool(5, 5 * N)
    estimate = measured_object(bodies[0].frame.depth)
    model = histogram(bodies[0].frame.depth, estimate)
    particles, weights = np.repeat(estimate[None], N, axis=0), np.full(N, 1 / N)
    speed, size, usual, learned = 0.0, estimate[3:], 0.0, []
    for step, (frame, _) in enumerate(bodies[1:]):
        depth = frame.depth
        track = tracker.update(frame)
        target = measured_object(depth)
        np.testing.assert_allclose(tracker._state.objects.states[:, 2].min(), target[2], atol=1e-6)
        growth = (0.5 + 0.5 * speed) * SECONDS
        deviation = np.array([0.03 + growth, 0.02 + 0.3 * growth, 0.03 + growth, *(0.06 * size)])  # (39)
        white, points = numbers.normal(step, (N, 5)), (np.arange(N) + numbers.uniform(step)) / N
        before = particles[np.searchsorted(weights.cumsum(), points, side="right")]
        particles, ratio = draw(before, deviation, target, white)
        weights = np.array([likelihood(depth, each, model) for each in particles]) * ratio  # (2)
        weights /= weights.sum()  # (31)
        speed = np.linalg.norm((weights @ particles - estimate)[:3]) / SECONDS
        estimate = weights @ particles
        np.testing.assert_allclose(tracker._state.particles.particles, particles, atol=1e-9)
        np.testing.assert_allclose(track.position, estimate[:3], atol=1e-9)
        confidence = np.log(likelihood(depth, estimate, model))
        learned.append(confidence >= usual - 0.5)
        if learned[-1]:
            usual += 0.1 * (confidence - usual)
            model = model + 0.08 * (histogram(depth, estimate) - model)
            size = size + PAPER.size_rate * (target[3:] - size)
    assert set(learned) == {True, False}
