# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.box import Box

from benchmarks.quality.common.degradations import DEGRADATIONS, scale_box

COLOR = np.full((30, 60, 3), (200, 100, 50), np.uint8)
IMAGES = [name for name, change in DEGRADATIONS.items() if change.step == change.box == 1]


@pytest.mark.parametrize("name", IMAGES)
@pytest.mark.parametrize("shape", [(30, 60, 3), (30, 60)])
def test_every_change_makes_an_image(name, shape):
    """Of color and of gray ones: contiguous bytes of the expected size; the same number, the same image."""
    image = np.random.default_rng(0).integers(0, 256, shape, dtype=np.uint8)
    change = DEGRADATIONS[name]
    before = image.copy()
    shown = change.apply(image, 7)
    assert shown.dtype == np.uint8
    assert shown.flags.c_contiguous
    assert shown.shape[:2] == (round(30 * change.scale), round(60 * change.scale))
    assert np.array_equal(shown, change.apply(image, 7))
    assert np.array_equal(image, before)
    changed = not np.array_equal(shown, image)
    no_colors = name in ("gray", "tint") and len(shape) == 2
    assert changed == (name != "as recorded" and not no_colors)


def test_light_is_what_the_names_say():
    """Dark is a fifth; flicker changes all channels alike, tint each by itself."""
    assert DEGRADATIONS["dark"].apply(COLOR, 0).mean() == pytest.approx(COLOR.mean() / 5, abs=1)
    bright, pale = (DEGRADATIONS["flicker"].apply(COLOR, number)[0, 0] / COLOR[0, 0] for number in (1, 4))
    assert np.ptp(bright) < 0.02
    assert bright.mean() > 1.2
    assert pale.mean() < 0.9
    assert np.ptp(DEGRADATIONS["tint"].apply(COLOR, 80)[0, 0] / COLOR[0, 0]) > 0.2


def test_noise_is_of_so_many_levels():
    """And differs from frame to frame."""
    flat = np.full((60, 60), 128, np.uint8)
    noisy = [DEGRADATIONS["noise"].apply(flat, number) for number in (0, 1)]
    assert noisy[0].std() == pytest.approx(20, rel=0.05)
    assert not np.array_equal(*noisy)


def test_a_box_is_scaled_around_its_middle():
    """Both sides, also where they differ."""
    assert scale_box(Box(10, 20, 20, 40), 1.5) == Box(5, 10, 30, 60)
