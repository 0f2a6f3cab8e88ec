# SPDX-License-Identifier: MIT
"""Where in the whole frame a lost target is looked for first."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from tricue import Intrinsics
from tricue import kernels as kernel_sets
from tricue.track.fused.depth_sources import DepthImageSource
from tricue.track.fused.experts.color import ColorExpert
from tricue.track.fused.experts.depth import DepthExpert
from tricue.track.fused.params import FusedParams
from tricue.track.fused.picture_observation import PictureObservation
from tricue.track.fused.proposals import LostTarget, propose_windows
from tricue.track.fused.target import Target
from tricue.track.fused.window import extract_window

P = FusedParams()
KERNELS = kernel_sets.load("native")
RED, GRAY = (40, 40, 220), (120, 120, 120)


def lost(target: Target, frame: int = 0) -> LostTarget:
    """Missed for a while."""
    return LostTarget(target, None, 20, frame)


def red_squares(width: int, height: int, *places: tuple[float, float], side: int = 24) -> PictureObservation:
    """A color picture with red squares around some places of a gray ground."""
    image = np.full((height, width, 3), GRAY, np.uint8)
    for x, y in places:
        left, top = int(x) - side // 2, int(y) - side // 2
        image[top : top + side, left : left + side] = RED
    camera = Intrinsics.from_fov(width, height, 60)
    return PictureObservation(KERNELS, image, camera, None, None)


def model_of(observation: PictureObservation, target: Target) -> Any:
    """What proposals need of a model that was learned of a target."""
    window = extract_window(observation, target, P.context)
    appearance = SimpleNamespace(color=ColorExpert.from_window(window))
    return SimpleNamespace(appearance=appearance, depth=None, params=P)


@pytest.mark.parametrize("size", [(320, 240), (200, 310), (437, 151)], ids=str)
@pytest.mark.parametrize("place", [(0.2, 0.3), (0.5, 0.5), (0.8, 0.6), (0.3, 0.75)], ids=str)
def test_the_place_of_its_colors_comes_first(size, place):
    """A target that went elsewhere is looked for where its colors are, to a few pixels of its 24."""
    width, height = size
    first = Target(width / 2, height / 2, 24.0, 24.0)
    model = model_of(red_squares(width, height, (first.x, first.y)), first)
    x, y = place[0] * width, place[1] * height
    found = propose_windows(model, red_squares(width, height, (x, y)), lost(first))[0].target
    assert (found.x, found.y) == pytest.approx((x, y), abs=5)


def test_places_of_its_colors_take_turns():
    """Of four places with its colors each is among the first three proposals of some frame of five, and of a
    frame's no two are nearer than the target's side.
    """
    first, places = Target(160.0, 120.0, 24.0, 24.0), [(60, 60), (100, 60), (250, 90), (200, 200)]
    model = model_of(red_squares(320, 240, (first.x, first.y)), first)
    observation = red_squares(320, 240, *places)
    seen = set()
    for frame in range(5):
        found = [each.target for each in propose_windows(model, observation, lost(first, frame))[:3]]
        for i, one in enumerate(found):
            assert all(max(abs(one.x - each.x), abs(one.y - each.y)) >= 23 for each in found[:i])
            seen |= {(x, y) for x, y in places if max(abs(one.x - x), abs(one.y - y)) < 5}
    assert seen == set(places)


@pytest.mark.parametrize("length", [0.4, 0.8])
def test_objects_of_its_size_in_meters_come_first(length):
    """Of two objects in a depth image that where the target's size in meters fits."""
    width, height, focal, z = 320, 240, 300.0, 3.0
    camera = Intrinsics(focal, focal, width / 2 - 0.5, height / 2 - 0.5, width, height)
    depth = np.full((height, width), 6.0, np.float32)
    places = {}
    for x, side in ((80, 0.4), (220, 0.8)):
        half = round(focal * side / z / 2)
        depth[120 - half : 120 + half, x - half : x + half] = z
        places[side] = x
    source = DepthImageSource(depth)
    observation = PictureObservation(KERNELS, None, camera, source, None)
    target = Target(160.0, 40.0, 40.0, 40.0)
    model: Any = SimpleNamespace(
        depth=DepthExpert(0.05, focal * length), params=P, limit_growth=lambda growth, _: growth
    )
    found = propose_windows(model, observation, lost(target))[0].target
    assert (found.x, found.y) == pytest.approx((places[length], 120), abs=3)
    assert found.side * z / focal == pytest.approx(length, rel=0.02)
