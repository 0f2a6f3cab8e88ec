# SPDX-License-Identifier: MIT
"""The growth of a target that flow measures, against waves that grow by a known factor."""

from functools import cache

import cv2
import numpy as np
import pytest
from tricue import kernels as kernel_sets
from tricue.camera.rig import Intrinsics
from tricue.track.fused.experts.flow import FLOW_REACH, FlowPatch, measure_growth
from tricue.track.fused.target import Target
from tricue.track.fused.target_observation import TargetObservation
from tricue.track.fused.window import PATCH_PIXELS, Window, extract_windows

SIZE = (200, 160)
CAMERA = Intrinsics(200.0, 200.0, 99.5, 79.5, *SIZE)
CENTER = (100.0, 80.0)
TARGET = Target(*CENTER, 44.0, 36.0)
FACTORS = [0.97, 0.985, 1.0, 1.015, 1.03]


@cache
def drawn(seed: int, factor: float = 1.0, right: float = 0.0, down: float = 0.0) -> np.ndarray:
    """(160, 200, 3) of 40 plane waves, grown by the factor about the target's center, then moved: exact, as
    no image is interpolated.
    """
    rng = np.random.default_rng(seed)
    length, angle, phase = rng.uniform(7, 40, 40), rng.uniform(0, np.pi, 40), rng.uniform(0, 2 * np.pi, 40)
    y, x = np.indices(SIZE[::-1]) + 0.5
    x, y = ((each - at - by) / factor for each, at, by in ((x, CENTER[0], right), (y, CENTER[1], down)))
    across, along = 2 * np.pi * np.cos(angle) / length, 2 * np.pi * np.sin(angle) / length
    waves = np.cos(across * x[..., None] + along * y[..., None] + phase).sum(axis=-1)
    return np.clip(np.rint(128 + 11 * waves), 0, 255).astype(np.uint8)[..., None].repeat(3, axis=2)


def seen(image: np.ndarray, target: Target = TARGET, kernels=None) -> Window:
    """A window of the image around the target."""
    k = kernels or kernel_sets.load("native")
    return extract_windows(TargetObservation(k, image, "color", CAMERA, None, None), [target], 3.0)[0]


def grown(before: np.ndarray, after: np.ndarray, target: Target = TARGET, kernels=None) -> float | None:
    """``measure_growth`` of two images, in the second one around ``target``."""
    first, second = seen(before, kernels=kernels), seen(after, target, kernels)
    return measure_growth(FlowPatch.cut(first, 0.0, 0.0), FlowPatch.cut(second, 0.0, 0.0), second)


@pytest.mark.parametrize("shift", [(0.0, 0.0), (0.7, -0.4), (-1.6, 1.3)], ids=str)
@pytest.mark.parametrize("factor", FACTORS)
def test_growth_is_the_factor(factor, shift):
    """Whatever the shift, the factor is found to half a percent."""
    for seed in range(3):
        assert grown(drawn(seed), drawn(seed, factor, *shift)) == pytest.approx(factor, abs=0.005)


@pytest.mark.parametrize("factor", FACTORS)
def test_growth_counts_the_windows_size(factor):
    """In a window that has grown with it nothing moves, and the factor is that of the windows."""
    found = grown(drawn(0), drawn(0, factor), TARGET.scale(factor))
    assert found == pytest.approx(factor, abs=0.005)


def test_there_and_back_is_one():
    """The growths between two frames forwards and backwards multiply to 1, to half a percent."""
    image, other = drawn(1), drawn(1, 1.025, 0.3, 0.2)
    assert grown(image, other) * grown(other, image) == pytest.approx(1, abs=0.005)


def test_sets_of_kernels_agree():
    """Native and reference kernels give the same to a ten thousandth."""
    image, other = drawn(2), drawn(2, 1.02, 0.5)
    native, reference = (
        grown(image, other, kernels=kernel_sets.load(each)) for each in ("native", "reference")
    )
    assert native == pytest.approx(reference, abs=1e-4)


def test_outliers_do_not_count():
    """A tenth of the target that stands still, as an occluder does, changes it by under a percent."""
    image, other = drawn(0), drawn(0, 1.025).copy()
    other[62:80, 80:90] = image[62:80, 80:90]
    assert grown(image, other) == pytest.approx(1.025, abs=0.01)


@pytest.mark.parametrize("blank", [0, 128, 255])
def test_a_blank_image_is_none(blank):
    """One color has no flow."""
    image = np.full((*SIZE[::-1], 3), blank, np.uint8)
    assert grown(image, image) is None


@pytest.mark.parametrize("seed", range(3))
def test_another_picture_is_none(seed):
    """Two pictures that have nothing to do with each other are no growth."""
    assert grown(drawn(seed), drawn(seed + 10)) is None


def test_a_target_of_a_few_pixels_is_none():
    """A target of under MIN_FLOW_PIXELS pixels of the patch has no growth."""
    tiny = Window(seen(drawn(0)).observation, Target(*CENTER, 4.0, 3.0), seen(drawn(0)).patch, 2.0)
    flow_patch = FlowPatch.cut(tiny, 0.0, 0.0)
    assert measure_growth(flow_patch, flow_patch, tiny) is None


@pytest.mark.parametrize("offset", [(0.0, 0.0), (9.0, -5.0), (300.0, -300.0)], ids=str)
def test_a_flow_patch_is_the_part_around_the_target(offset):
    """It is gray, 41 pixels a side, has the target at its center, and ends where the window's patch does."""
    view, (right, down) = seen(drawn(0)), offset
    gray = cv2.cvtColor(view.patch, cv2.COLOR_BGR2GRAY)
    last = PATCH_PIXELS - 2 * FLOW_REACH - 1
    i, j = (min(max(PATCH_PIXELS // 2 - FLOW_REACH + round(each), 0), last) for each in (down, right))
    flow_patch = FlowPatch.cut(view, right, down)
    np.testing.assert_array_equal(flow_patch.gray, gray[i : i + 41, j : j + 41])
    assert flow_patch.pixel_size == view.pixel_size
