# SPDX-License-Identifier: MIT
"""The color camera in falling light: gain, noise, and nothing in darkness."""

import numpy as np
import pytest
from tricue.scenes.sensor.low_light import LowLightSensor

SENSOR = LowLightSensor()
GRAY = np.full((100, 100, 3), 120.0, np.float32)


def exposed(light: float, picture=GRAY):
    """An image of the picture."""
    return SENSOR.expose(picture, light, np.random.default_rng(1)).astype(float)


def test_indoors_a_picture_is_itself():
    """Under the light 1 the mean is the picture, and the noise that of its photons and of reading."""
    electrons = 120 / 255 * SENSOR.full_well
    noise = np.sqrt(electrons + SENSOR.read_noise**2) * 255 / SENSOR.full_well
    assert exposed(1.0).mean() == pytest.approx(120, abs=0.1)
    assert exposed(1.0).std() == pytest.approx(np.hypot(noise, np.sqrt(1 / 12)), rel=0.03)


def test_gain_makes_up_until_it_ends():
    """Down to a sixteenth of the light images are as bright, then they darken."""
    assert exposed(1 / 16).mean() == pytest.approx(120, abs=0.5)
    assert exposed(1 / 32).mean() == pytest.approx(60, abs=0.5)


def test_noise_grows_as_light_falls():
    """The noise of an image that the gain keeps as bright grows more than its light's root falls."""
    assert exposed(1 / 16).std() > 4 * exposed(1.0).std()


def test_more_light_is_shut_out():
    """A hundredfold light gives the image of the light 1, by a shorter exposure."""
    np.testing.assert_array_equal(exposed(100.0), exposed(1.0))


def test_darkness_shows_nothing():
    """Without light an image has noise of a few levels, and doesn't depend on what is there."""
    np.testing.assert_array_equal(exposed(0.0), exposed(0.0, np.zeros_like(GRAY)))
    assert 0 < exposed(0.0).mean() < 4
