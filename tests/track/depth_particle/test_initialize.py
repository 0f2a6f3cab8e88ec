# SPDX-License-Identifier: MIT
"""What is known of a target that starts in a box at the image's border."""

import numpy as np
import pytest
from tricue import Box, Intrinsics, _core
from tricue.track.depth_objects.floor import NO_FLOOR
from tricue.track.depth_objects.foreground import Foreground
from tricue.track.depth_objects.objects import segment
from tricue.track.depth_particle.initialize import initialize_in_box
from tricue.track.depth_particle.params import DepthParticleParams

WIDTH, HEIGHT = 176, 144
CAMERA = Intrinsics.from_fov(WIDTH, HEIGHT, 47.5, 39.5).vector


def start(left: int, box: Box):
    """The target in a box around a flat person, 26 columns wide, at 3 m, whose first column is ``left``."""
    depth = np.full((HEIGHT, WIDTH), np.nan, np.float32)
    depth[30:120, max(left, 0) : left + 26] = 3
    fg = Foreground(depth, CAMERA, 1, (0, 0, WIDTH, HEIGHT))
    p = DepthParticleParams()
    return initialize_in_box(box, segment(_core, fg, NO_FLOOR, p), fg, p)


@pytest.mark.parametrize("beyond", [0, 8])
def test_a_box_may_reach_beyond_the_border(beyond):
    """What is wholly visible isn't cut, though the box that was drawn around it is."""
    target = start(5, Box(-beyond, 30, 31 + beyond, 90))
    assert target.whole.all()
    assert target.state[3] == pytest.approx(26 * 3 / CAMERA[0], rel=0.05)


def test_who_is_cut_by_the_border_is_not_whole():
    """Of a person who isn't wholly in the image no size is known, with a box in the image, too."""
    for box in (Box(-8, 30, 26, 90), Box(0, 30, 18, 90)):
        assert not start(-8, box).whole.any()
