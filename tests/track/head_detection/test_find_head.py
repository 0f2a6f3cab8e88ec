# SPDX-License-Identifier: MIT
"""That heads on shoulders are found in stereo pairs and in depth, and nothing where there is none."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Frame, kernels
from tricue.data.open_source import open_source
from tricue.scenes import head, room_scene, stress_scene
from tricue.track.head_detection.find_head import find_head_in_depth, find_head_in_pair

Image = NDArray[np.uint8]
BASELINE = 0.12


def find(left: Image, right: Image, baseline: float = BASELINE) -> Box | None:
    """The head that is found with native kernels."""
    return find_head_in_pair(kernels.load("native"), left, right, baseline)


def find_in_depth(frame: Frame, focal_length: float) -> Box | None:
    """The same in color and depth."""
    assert frame.color is not None
    assert frame.depth is not None
    return find_head_in_depth(kernels.load("native"), frame.color, frame.depth, focal_length)


@pytest.mark.parametrize("seed", range(3))
def test_heads_are_found(rendered: Callable[..., Any], seed: int) -> None:
    """It proves that heads of walkers at 1 to 4 m are found in at least 95 % of the frames, with no box that
    is off.
    """
    scene = rendered(head, seed=seed, frames=24)
    found = [find(frame.color, frame.right, scene.rig.baseline) for frame in scene.frames[::2]]
    overlaps = [
        0 if box is None else box.iou(true) for box, true in zip(found, scene.boxes[::2], strict=True)
    ]
    assert np.mean(np.array(overlaps) > 0.5) >= 0.95


def test_backs_of_heads_are_found(rendered: Callable[..., Any]) -> None:
    """It proves that a person who shows hair alone is found as well: no face is needed."""
    scene = rendered(head, seed=1, frames=60, kind="turning")
    away = [index for index in range(60) if scene.facing[index] > 2]
    assert away
    for index in away[::5]:
        frame = scene.frames[index]
        found = find(frame.color, frame.right, scene.rig.baseline)
        assert found is not None
        assert found.iou(scene.boxes[index]) > 0.5


def test_boxes_are_close(rendered: Callable[..., Any]) -> None:
    """It proves that the boxes of heads of 8 to 20 px are off by a pixel or so, not by a window's width."""
    scene = rendered(head, seed=1, frames=24)
    found = [find(frame.color, frame.right, scene.rig.baseline) for frame in scene.frames[::4]]
    overlaps = [box.iou(true) for box, true in zip(found, scene.boxes[::4], strict=True) if box is not None]
    assert len(overlaps) == len(found)
    assert np.mean(overlaps) > 0.85


def test_gray_pairs_will_do(rendered: Callable[..., Any]) -> None:
    """It proves that a pair without colors shows its heads, too."""
    scene = rendered(head, seed=0, frames=24)
    frame = scene.frames[0]
    weights = np.array([0.114, 0.587, 0.299])
    gray = [np.round(image @ weights).astype(np.uint8) for image in (frame.color, frame.right)]
    found = find(*gray, scene.rig.baseline)
    assert found is not None
    assert found.iou(scene.boxes[0]) > 0.5


@pytest.mark.parametrize("seed", range(3))
def test_heads_are_found_in_depth(rendered: Callable[..., Any], seed: int) -> None:
    """It proves that in rooms with people, of whom some hide others, color and depth give the head of one."""
    scene = rendered(room_scene, kind="walker", seed=seed, channels="rgbd")
    found, on_target = 0, 0
    for frame, (x, y, width, height) in zip(scene.frames[::15], scene.boxes[::15], strict=True):
        box = find_in_depth(frame, scene.intrinsics.fx)
        found += box is not None
        if box is not None and x < box.center[0] < x + width:
            assert abs(box.y - y) < 0.05 * height
            on_target += 1
    assert found >= 3
    assert on_target >= 1


def test_no_head_in_depth_is_none(rendered: Callable[..., Any]) -> None:
    """It proves that things in the air and on a floor, and depth that shows nothing, give no box."""
    for kind in ("fast", "hidden"):
        scene = rendered(stress_scene, kind=kind, seed=0, channels="rgbd")
        assert all(find_in_depth(frame, scene.intrinsics.fx) is None for frame in scene.frames[:30:10])
    k, image = kernels.load("native"), np.zeros((40, 40, 3), np.uint8)
    for shape in ((40, 40), (3, 3), (1, 1), (2, 200)):
        assert find_head_in_depth(k, image, np.full(shape, np.nan, np.float32), 300.0) is None
        assert find_head_in_depth(k, image, np.zeros(shape, np.float32), 300.0) is None
        assert find_head_in_depth(k, image, np.full(shape, 1e-40, np.float32), 300.0) is None


@pytest.mark.parametrize("name", ["kitchen-mug", "yellow-dragon"])
def test_recorded_things_are_no_heads(data: Path, name: str) -> None:
    """It proves that recordings of things, on a table and of a moving camera, give no box."""
    for index, frame in enumerate(open_source(data / "rgbd" / name)):
        if index % 10 == 0:
            assert find_in_depth(frame, 525.0) is None, index


def test_a_recorded_head_is_found(data: Path) -> None:
    """It proves that of people in recorded color and depth one's head is found: at the top of a true box."""
    source = open_source(data / "rgbd" / "walker-purple")
    hits = 0
    for index, frame in enumerate(source):
        box, true = find_in_depth(frame, 525.0), source.true_box(index)
        if box is not None and true is not None and true.x < box.center[0] < true.x + true.width:
            hits += box.center[1] < true.y + 0.2 * true.height
    assert hits >= 3


def test_no_head_is_none(rendered: Callable[..., Any]) -> None:
    """It proves that noise, a blank frame, a plane, and images of a few pixels give no box."""
    rng = np.random.default_rng(0)
    noise = rng.integers(0, 256, (2, 120, 160), np.uint8)
    blank = np.full((120, 160, 3), 90, np.uint8)
    left = rendered(head, seed=0, frames=24).frames[0].color
    assert find(*noise) is None
    assert find(blank, blank) is None
    assert find(left, np.roll(left, -10, axis=1)) is None
    for shape in ((3, 3), (1, 1), (40, 2), (2, 200)):
        assert find(np.zeros(shape, np.uint8), np.zeros(shape, np.uint8)) is None


def test_both_kernels_find_the_same(rendered: Callable[..., Any]) -> None:
    """It proves that native kernels and twins give the same box, bit for bit."""
    scene = rendered(head, seed=0, frames=24)
    frame = scene.frames[0]
    boxes = [
        find_head_in_pair(kernels.load(name), frame.color, frame.right, scene.rig.baseline)
        for name in ("native", "reference")
    ]
    assert boxes[0] is not None
    assert boxes[0] == boxes[1]


def test_a_head_has_a_heads_size(rendered: Callable[..., Any]) -> None:
    """It proves that a thing of a head's shape but four times its size isn't a head."""
    scene = rendered(head, seed=0, frames=24)
    frame = scene.frames[0]
    found = find(frame.color, frame.right, 4 * scene.rig.baseline)
    assert found is None or found.iou(scene.boxes[0]) < 0.2
