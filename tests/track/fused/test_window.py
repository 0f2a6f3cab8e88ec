# SPDX-License-Identifier: MIT
"""The fused tracker's targets, and the windows around them."""

import numpy as np
import pytest
from tricue import Box, Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.target import Target
from tricue.track.fused.window import PATCH_PIXELS, Window, extract_windows

CAMERA = Intrinsics.from_fov(250, 200, 60)


def test_target_and_box():
    """A target made of a box gives the box back; shifted it keeps its size, and scaled its center."""
    box = Box(10.0, 20.0, 30.0, 40.0)
    target = Target.of(box)
    assert target.box == pytest.approx(box)
    assert target.side == pytest.approx(np.sqrt(1200))
    assert target.shift(3.0, -2.0).box == pytest.approx((13, 18, 30, 40))
    assert target.scale(2.0).box.center == box.center
    assert target.scale(2.0).side == pytest.approx(2 * target.side)


def window_around(target: Target, context: float = 3.0) -> Window:
    """A window of an image whose pixels give their place: blue the column, green the row."""
    rows, columns = np.indices((200, 250)).astype(np.uint8)
    picture = np.dstack([columns, rows, np.zeros_like(rows)])
    return extract_windows(
        PictureObservation(kernel_sets.load("native"), picture, CAMERA, None, None), [target], context
    )[0]


def test_a_window_is_around_its_target():
    """A window of 64 pixels a side has its target at the center, and the image's pixels there."""
    window = window_around(Target(120.0, 90.0, 32.0, 32.0), 2.0)  # 64 pixels of the image: one each
    assert window.patch.shape == (PATCH_PIXELS, PATCH_PIXELS, 3)
    assert window.pixel_size == 1.0
    assert window.size == (32.0, 32.0)
    assert window.patch[0, 0].tolist() == [88, 58, 0]
    assert window.patch[63, 63].tolist() == [151, 121, 0]


@pytest.mark.parametrize("share", [1.0, 0.8, 0.3])
@pytest.mark.parametrize("offset", [(0.0, 0.0), (6.0, -4.0), (-10.0, 10.0)])
def test_inner_is_the_targets_part(share, offset):
    """Rows and columns of a target so far off the center are those whose pixels lie in its box, to one."""
    target, (right, down) = Target(120.0, 90.0, 40.0, 24.0), offset
    window = window_around(target, 2.0)
    rows, columns = window.inner(right, down, share)
    own = window.patch[rows, columns, :2].reshape(-1, 2).astype(float)
    center = np.array([120 + window.pixel_size * right, 90 + window.pixel_size * down])
    half = share * np.array([40.0, 24.0]) / 2
    assert own.min(axis=0) + 0.5 == pytest.approx(center - half, abs=1.5)
    assert own.max(axis=0) + 0.5 == pytest.approx(center + half, abs=1.5)


@pytest.mark.parametrize("offset", [0.0, 31.0, 40.0, -40.0, 1e6, -1e6])
@pytest.mark.parametrize("size", [(0.01, 0.01), (20.0, 30.0), (1e5, 1e5)])
def test_inner_is_never_empty(offset, size):
    """However far off or small the target is, there is a pixel of it, within the patch."""
    window = Window(
        window_around(Target(9, 9, 9, 9)).observation,
        Target(50, 50, *size),
        np.zeros((64, 64, 3), np.uint8),
        1.0,
    )
    for span in window.inner(offset, -offset, 0.8):
        assert 0 <= span.start < span.stop <= PATCH_PIXELS
