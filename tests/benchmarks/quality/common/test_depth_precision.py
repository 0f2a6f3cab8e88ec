# SPDX-License-Identifier: MIT
import cv2
import numpy as np
import pytest

from benchmarks.quality.common import depth_precision
from benchmarks.quality.common.depth_precision import PATCH


@pytest.mark.parametrize("z", [1.0, 2.0, 4.0])
def test_quantization_is_the_levels_distance(z):
    """Levels of 1/z, 2.85e-3 per meter apart, are 2.85e-3 z² meters apart in depth, to a millimeter."""
    values = np.random.default_rng(0).uniform(0.5, 5.0, 400_000)
    levels = 1 / (np.rint(1 / values / 2.85e-3) * 2.85e-3)
    assert depth_precision.quantization(levels, z) == pytest.approx(2.85e-3 * z**2, abs=1e-3)
    assert np.isnan(depth_precision.quantization(levels[:3], z))


@pytest.mark.parametrize(("grain", "low"), [(0.0, 0.9), (0.8, 0.75)])
def test_noise_about_tilted_planes(grain, low):
    """The lower quartile of planes' deviations is a little under the noise's; edges don't count. The
    correlation between neighbors is exp(-1 / (4 grain²)) of blurred noise, less the low
    frequencies that planes take.
    """
    rng = np.random.default_rng(1)
    noise = rng.standard_normal((30 * PATCH, 40 * PATCH))
    if grain:
        noise = cv2.GaussianBlur(noise, (0, 0), grain)
    depth = 2.0 + 1e-4 * np.arange(40 * PATCH) + 5e-3 * noise / noise.std()
    depth[:, : 15 * PATCH : PATCH] += 0.5  # an edge in more than a third of the patches
    found = depth_precision.flat_noise(depth_precision.flat_patches(depth), 2.0)
    assert low * 5e-3 < found.deviation < 5e-3
    expected = np.exp(-1 / (4 * grain**2)) if grain else 0.0
    assert expected - 0.15 < found.grain < expected + 0.03


def test_patches_with_holes_are_left_out():
    """Only those measured in every pixel count, and few are none."""
    depth = np.full((2 * PATCH, 3 * PATCH + 4), 1.0)
    depth[3, 5] = np.nan
    patches = depth_precision.flat_patches(depth)
    assert len(patches) == 5
    assert np.isnan(depth_precision.flat_noise(patches, 1.0).deviation)


def test_flying_pixels_are_counted_per_step():
    """Clean steps have none; a single pixel between both surfaces is counted once for each column that sees
    it in the middle; steps with holes don't count.
    """
    depth = np.full((20, 60), 3.0)
    depth[:, 20:40] = 1.0
    assert depth_precision.flying_pixels(depth) == (40, 0)
    depth[:, 20] = 2.0
    steps, between = depth_precision.flying_pixels(depth)
    assert between == 20
    assert steps == pytest.approx(40, abs=5)
    depth[:, 19:21] = depth[:, 39:41] = np.nan
    assert depth_precision.flying_pixels(depth) == (0, 0)
