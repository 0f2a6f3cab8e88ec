# SPDX-License-Identifier: MIT
from functools import lru_cache

import cv2
import numpy as np
import pytest

pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")

from tricue.scenes.stress.scene import stress_scene


@lru_cache(maxsize=6)
def scene(kind, seed, channels):
    """A scene, without noise in its color images."""
    return stress_scene(kind, seed, channels=channels, noise=0)


def whole(made):
    """The frames in which the target is seen whole, with some pixels of margin in the picture."""
    return [int(index) for index in np.flatnonzero(made.visible == 1)[::9]]


@pytest.mark.parametrize("kind", ["scale", "camera", "plain"])
def test_depth_at_the_targets_middle_is_its_distance(kind):
    """The mean of the depths about the target's middle is its Z: within half of the sensor's deviation, for
    81 pixels average it, and a millimeter, for the middle is rounded to a pixel of a tilted card.
    """
    made = scene(kind, 1, "depth")
    for index in whole(made):
        u, v = made.intrinsics.project(made.positions[index]).round().astype(int)
        z = made.positions[index, 2]
        around = made.frames[index].depth[v - 4 : v + 5, u - 4 : u + 5]
        if np.isfinite(around).sum() > 40:
            assert np.nanmean(around) == pytest.approx(z, abs=0.5 * 1.425e-3 * z**2 + 0.001)


def test_depth_is_whole_millimeters_of_a_sensor_with_gaps():
    """Depths are multiples of a millimeter; some 3 % are missing; none is beyond the wall."""
    made = scene("plain", 1, "depth")
    depth = np.stack([frame.depth for frame in made.frames[::10]])
    known = np.isfinite(depth)
    assert 0.95 < known.mean() < 0.99
    units = depth[known] / 0.001
    assert np.abs(units - np.rint(units)).max() < 1e-2
    assert depth[known].max() < 7
    assert np.median(depth[known]) > 4  # mostly the wall


@pytest.mark.parametrize(("kind", "seed"), [("scale", 1), ("camera", 2), ("plain", 1)])
def test_disparity_is_focal_length_times_baseline_over_distance(kind, seed):
    """A patch of the target's middle in the left image is found in the right one at f b / Z, subpixel."""
    made = scene(kind, seed, "stereo")
    rig = made.rig
    for index in whole(made):
        u, v = made.intrinsics.project(made.positions[index]).round().astype(int)
        true = rig.intrinsics.fx * rig.baseline / made.positions[index, 2]
        half = int(min(made.boxes[index, 2:]) / 3)
        if u - half - true - 6 < 0:
            continue
        frame = made.frames[index]
        assert disparity(frame.color, frame.right, u, v, half, round(true)) == pytest.approx(true, abs=0.35)


def test_depth_and_disparity_of_the_wall_agree():
    """Where nothing but the wall is, f b / disparity is what the depth camera measures."""
    stereo, depth = (scene("plain", 1, channels) for channels in ("stereo", "depth"))
    (u, v), half = (80, 40), 20
    around = np.s_[v - half : v + half + 1, u - half - 15 : u + half + 1]
    assert not depth.masks[0][around].any()
    z = np.nanmean(depth.frames[0].depth[around])
    found = disparity(stereo.frames[0].color, stereo.frames[0].right, u, v, half, 6)
    assert found == pytest.approx(stereo.rig.intrinsics.fx * stereo.rig.baseline / z, abs=0.35)


def disparity(left, right, u, v, half, near):
    """By normalized cross-correlation of a square round (u, v), a parabola through the best three."""
    patch = left[v - half : v + half + 1, u - half : u + half + 1]
    first = u - half - near - 5
    strip = right[v - half : v + half + 1, max(first, 0) : u + half + 1 - near + 5]
    scores = cv2.matchTemplate(strip, patch, cv2.TM_CCOEFF_NORMED)[0]
    best = int(scores.argmax())
    assert scores[best] > 0.9
    assert 0 < best < len(scores) - 1
    a, b, c = scores[best - 1 : best + 2]
    return u - half - (max(first, 0) + best + (a - c) / (2 * (a - 2 * b + c)))
