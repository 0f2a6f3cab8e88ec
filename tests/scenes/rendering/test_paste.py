# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.scenes.rendering.paste import ellipse_mask, expose, paste

GROUND = np.full((40, 50, 3), 20, np.float32)
RNG_SEED = 4


def test_whole_positions_copy_pixels():
    """At whole coordinates a cut-out lands pixel for pixel on [x, x + w) x [y, y + h), and nowhere else."""
    cutout = np.random.default_rng(RNG_SEED).uniform(30, 200, (9, 7, 3)).astype(np.float32)
    image = paste(GROUND, cutout, np.ones((9, 7), np.float32), 11, 5)
    np.testing.assert_array_equal(image[5:14, 11:18], cutout)
    image[5:14, 11:18] = 20
    np.testing.assert_array_equal(image, GROUND)


@pytest.mark.parametrize(("x", "y"), [(10.0, 8.0), (10.25, 8.5), (17.96875, 3.03125)])
def test_center_of_what_was_pasted_is_the_center_of_the_box(x, y):
    """The centroid of the added light is the center of the true box, between pixels too."""
    image = paste(GROUND, np.full((12, 10, 3), 120, np.float32), ellipse_mask(12, 10, 2.0), x, y)
    added = image[..., 0] - 20
    rows, columns = np.indices(added.shape) + 0.5
    centroid = [(columns * added).sum() / added.sum(), (rows * added).sum() / added.sum()]
    np.testing.assert_allclose(centroid, [x + 5, y + 6], atol=1e-3)


def test_cutout_may_reach_over_the_edge():
    """The part outside the picture is cut off, the part inside is there."""
    image = paste(GROUND, np.full((8, 8, 3), 90, np.float32), np.ones((8, 8), np.float32), -3, 35)
    np.testing.assert_array_equal(image[35:, :5], 90)
    assert (image == 90).sum() == 5 * 5 * 3


def test_mask_is_an_ellipse():
    """The opacity is 1 at the center, 0 at the corners, symmetric; half of it bounds the ellipse."""
    mask = ellipse_mask(63, 50, 2.0)
    assert mask[31, 25] == 1
    assert mask[0, 0] == mask[0, -1] == mask[-1, 0] == 0
    np.testing.assert_allclose(mask, mask[::-1, ::-1], atol=1e-6)
    assert mask.sum() == pytest.approx(np.pi / 4 * 61 * 48, rel=0.02)


def test_sensor_adds_the_noise_asked_for():
    """The noise has the deviation asked for (and rounding's 1/12), no bias, and saturates at 0 and 255."""
    image = expose(np.full((200, 200, 3), 100, np.float32), 3.0, np.random.default_rng(RNG_SEED))
    assert image.std() == pytest.approx(np.sqrt(9 + 1 / 12), rel=0.02)
    assert image.mean() == pytest.approx(100, abs=0.05)
    dark = expose(np.full((9, 9, 3), -40, np.float32), 3.0, np.random.default_rng(RNG_SEED))
    bright = expose(np.full((9, 9, 3), 290, np.float32), 3.0, np.random.default_rng(RNG_SEED))
    assert (dark.max(), bright.min()) == (0, 255)
