# SPDX-License-Identifier: MIT
"""The color models that the paper compares its ranks with."""

import numpy as np
import pytest
from tricue import ColorParticleTracker
from tricue.track.color_particle.color_models import Gaussian
from tricue.track.color_particle.observation_model import WindowSamples


@pytest.mark.parametrize("color", [(255, 0, 0), (0, 255, 0), (0, 0, 255), (90, 120, 200)])
def test_the_gaussian_peaks_at_the_color_that_it_has_learned(kernels, color):
    """It learns chrominance as skin_gaussian computes it: in a window of one color the density is 1."""
    window = np.repeat(np.array(color, np.uint8), 50).reshape(1, 3, 50)
    blank = Gaussian.create(ColorParticleTracker.Params())
    model = blank.learn(kernels, WindowSamples(window, window), 1.0)
    density = kernels.skin_gaussian(window, model.mean, np.linalg.inv(model.covariance))
    np.testing.assert_allclose(density, 1, atol=1e-6)
