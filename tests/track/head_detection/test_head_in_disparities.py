# SPDX-License-Identifier: MIT
"""That heads on shoulders are found in stereo pairs, and nothing where there is none."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, kernels
from tricue.scenes import head
from tricue.track.head_detection.head_in_disparities import find_head_in_disparities

Image = NDArray[np.uint8]
BASELINE = 0.12


def find(left: Image, right: Image, baseline: float = BASELINE) -> Box | None:
    """The head that is found with native kernels."""
    return find_head_in_disparities(kernels.load("native"), left, right, baseline)


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


def test_gray_pairs_are_as_good(rendered: Callable[..., Any]) -> None:
    """It proves that the colors aren't used."""
    scene = rendered(head, seed=0, frames=24)
    frame = scene.frames[0]
    weights = np.array([0.114, 0.587, 0.299])
    gray = [np.round(image @ weights).astype(np.uint8) for image in (frame.color, frame.right)]
    found = find(*gray, scene.rig.baseline)
    assert found is not None
    assert found.iou(scene.boxes[0]) > 0.5


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
        find_head_in_disparities(kernels.load(name), frame.color, frame.right, scene.rig.baseline)
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
