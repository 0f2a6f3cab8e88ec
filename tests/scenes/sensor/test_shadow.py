# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.scenes.sensor.shadow import cast_shadow

FX = 400.0


@pytest.fixture
def board():
    """A board at 1 m in columns 100 to 149, before a wall at 2 m."""
    depth = np.full((4, 240), 2.0)
    depth[:, 100:150] = 1.0
    return depth


@pytest.mark.parametrize("baseline", [0.05, -0.05, 0.03])
def test_width_and_side_are_the_geometry_s(board, baseline):
    """f b (1/near - 1/far) pixels, left of the board if the projector is right of the camera, else right."""
    shadow = cast_shadow(board, FX, baseline)
    width = round(FX * abs(baseline) / 2)
    expected = np.zeros(board.shape, bool)
    expected[:, slice(100 - width, 100) if baseline > 0 else slice(150, 150 + width)] = True
    assert np.array_equal(shadow, expected)


def test_shadow_is_what_a_ray_to_the_projector_hits(board):
    """Each wall pixel by itself: whether its ray to the projector passes through the board."""
    baseline, cx = 0.0737, 119.5
    x = (np.arange(240) - cx) / FX * 2  # on the wall
    crossing = (x + baseline) / 2  # halfway, at 1 m
    low, high = (99.5 - cx) / FX, (149.5 - cx) / FX
    hit = (crossing > low) & (crossing < high) & (board[0] == 2)
    assert np.abs(cast_shadow(board, FX, baseline)[0].astype(int) - hit).sum() <= 1
    assert hit.sum() > 10


def test_a_smooth_surface_has_none():
    """Neither a plane nor a slope that the projector sees casts a shadow on itself."""
    slope = np.tile(np.linspace(1.0, 1.5, 240), (3, 1))
    assert not cast_shadow(slope, FX, 0.05).any()
    assert not cast_shadow(np.full((3, 240), 1.3), FX, 0.05).any()
