# SPDX-License-Identifier: MIT
"""The Gaussian of the skin pixels."""

import numpy as np
import pytest
from tricue import kernels
from tricue.track.color_particle import skin_detection
from tricue.track.color_particle.motion import EllipsePrediction
from tricue.track.color_particle.params import ColorParticleParams

SKIN = np.array([80, 110, 180], np.uint8)


@pytest.mark.parametrize("top", [-300, 0, 37])
def test_of_many_rows_every_nth_tells_the_same(top, monkeypatch):
    """A large slanted patch, partly outside of the image, has the Gaussian that all of its pixels have."""
    center = 330.0, top + 450.0
    y, x = np.mgrid[:900, :700] + 0.5
    patch = (x - center[0] + 0.4 * (y - center[1])) ** 2 / 150**2 + (y - center[1]) ** 2 / 260**2 < 1
    image = np.where(patch[..., None], SKIN, np.array([120, 90, 60], np.uint8)).astype(np.uint8)
    low, high = (center[0] - 40, top + 300.0, 1.0, 1.0), (center[0] + 40, top + 600.0, 200.0, 300.0)
    prediction = EllipsePrediction((0, 0, 0, 0), (1, 1, 1, 1), low, high)
    counting, found = _Counting(), []
    few_rows = skin_detection.SKIN_ROWS
    for rows in (few_rows, 10_000):
        monkeypatch.setattr(skin_detection, "SKIN_ROWS", rows)
        ellipse = (*center, 120.0, 200.0)
        found.append(
            skin_detection.detect_skin(counting, image, SKIN, ellipse, prediction, ColorParticleParams())
        )
    few, all_of_them = found
    assert counting.rows[0] < 2 * few_rows < 500 < counting.rows[1]
    np.testing.assert_allclose(few.mean, all_of_them.mean, atol=1)
    np.testing.assert_allclose(few.root, all_of_them.root, atol=1)


class _Counting:
    """Kernels that note how many rows the moments were taken of."""

    def __init__(self):
        self.rows = []

    def skin_moments(self, image, reference, threshold, region, step):
        self.rows.append((min(region[3], len(image)) - max(region[1], 0)) // step)
        return kernels.load("native").skin_moments(image, reference, threshold, region, step)
