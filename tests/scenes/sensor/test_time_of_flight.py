# SPDX-License-Identifier: MIT
"""The time-of-flight camera: its noise by its photons, and what lies beyond its unambiguous range."""

import numpy as np
import pytest
from tricue import Intrinsics
from tricue.scenes.sensor.time_of_flight import SPEED_OF_LIGHT, TimeOfFlightCamera

# A long focal length: rays are parallel, and depth is distance, to a ten thousandth.
NARROW = TimeOfFlightCamera(Intrinsics(6000.0, 6000.0, 49.5, 49.5, 100, 100))
SHAPE = 100, 100


def flat(depth: float, reflectance: float = 0.5, light: float = 0.0, camera=NARROW):
    """The image of a wall."""
    rng = np.random.default_rng(1)
    return camera.measure(np.full(SHAPE, depth), np.full(SHAPE, reflectance), light, rng)


def test_twenty_megahertz_reach_seven_and_a_half_meters():
    """The SR-3000's range as the paper has it, section VI."""
    assert NARROW.unambiguous_range == pytest.approx(7.5, abs=0.01)


@pytest.mark.parametrize(("depth", "deviation"), [(2.0, 0.01), (6.0, 0.03)])
def test_noise_in_darkness_is_the_other_sensors(depth, deviation):
    """1 cm at 2 m and 3 cm at 6 m, of a surface of reflectance one half."""
    measured = flat(depth).depth
    assert measured.mean() == pytest.approx(depth, abs=0.002)
    assert measured.std() == pytest.approx(deviation, rel=0.05)


def test_amplitude_falls_with_the_square_and_with_the_reflectance():
    """Twice as far is a quarter of the electrons, half as bright half of them."""
    base = flat(2.0).amplitude.mean()
    assert base == pytest.approx(0.5 * NARROW.signal / 4, rel=0.01)
    assert flat(4.0).amplitude.mean() == pytest.approx(base / 4, rel=0.01)
    assert flat(2.0, 0.25).amplitude.mean() == pytest.approx(base / 2, rel=0.01)


def test_ambient_light_adds_shot_noise():
    """By Lange and Seitz the deviation grows with the root of all electrons; the mean stays."""
    dark, bright = flat(3.0), flat(3.0, light=10.0)
    signal, ambient = 0.5 * NARROW.signal / 9, 0.5 * NARROW.ambient * 10
    assert bright.depth.mean() == pytest.approx(3.0, abs=0.005)
    assert bright.depth.std() / dark.depth.std() == pytest.approx(np.sqrt(1 + ambient / signal), rel=0.05)


@pytest.mark.parametrize(("depth", "apparent"), [(7.0, 7.0), (9.0, 1.5), (17.0, 2.0)])
def test_beyond_the_range_is_near(depth, apparent):
    """What is farther than c / 2f seems to be nearer by a multiple of it."""
    camera = NARROW._replace(modulation=SPEED_OF_LIGHT / 15)  # 7.5 m
    assert np.median(flat(depth, camera=camera).depth) == pytest.approx(apparent, abs=0.02)


def test_phases_measure_along_rays():
    """At the corner of a wide image a wall wraps at a depth below the range, as its ray is longer."""
    wide = TimeOfFlightCamera(Intrinsics(50.0, 50.0, 49.5, 49.5, 100, 100), SPEED_OF_LIGHT / 15)
    depth = flat(6.0, camera=wide).depth
    assert depth[50, 50] == pytest.approx(6.0, abs=0.2)
    length = np.sqrt(1 + 2 * 0.99**2)
    assert depth[0, 0] == pytest.approx((6.0 * length - 7.5) / length, abs=0.3)


@pytest.mark.parametrize(
    ("depth", "reflectance", "light"),
    [(np.inf, 0.5, 0.0), (7.0, 0.01, 0.0), (3.0, 0.5, 100.0), (0.2, 0.5, 0.0)],
    ids=["nothing", "too dark", "saturated", "too near"],
)
def test_what_cannot_be_measured_is_missing(depth, reflectance, light):
    """Without an echo, of too few electrons, of too many, or too near there is no depth, and no warning."""
    assert np.isnan(flat(depth, reflectance, light).depth).all()


def test_amplitude_tells_what_is_too_far():
    """A wall beyond the range is darker than anything where it seems to be, and is discarded by that; what is
    within the range is kept.
    """
    camera = NARROW._replace(modulation=SPEED_OF_LIGHT / 15, min_reflectance=0.15)
    assert np.isnan(flat(10.0, camera=camera).depth).mean() > 0.99
    assert np.isfinite(flat(4.0, camera=camera).depth).all()
    assert np.isfinite(flat(10.0, camera=camera._replace(min_reflectance=0.0)).depth).all()


def test_edges_have_pixels_between():
    """Of the pixels at an edge some measure a depth between both surfaces."""
    depth = np.full(SHAPE, 5.0)
    depth[:, 50:] = 3.0
    measured = NARROW.measure(depth, np.full(SHAPE, 0.5), 0.0, np.random.default_rng(1)).depth
    between = (measured > 3.3) & (measured < 4.7)
    assert 0.1 < between[:, 49:51].mean() < 0.6
    assert not between[:, :48].any()
