# SPDX-License-Identifier: MIT
"""The paper's equations in the stereo head tracker's printed form, each against its own arithmetic."""

from dataclasses import replace

import numpy as np
import pytest
from tricue import Box, Frame, Intrinsics, Status, StereoHeadTracker, StereoRig
from tricue import kernels as kernel_sets
from tricue.track.stereo_head.disparity import limits_around, measure_disparity
from tricue.track.stereo_head.prepared_pair import PreparedPair

Params = StereoHeadTracker.Params
PAPER = Params.paper()
ELLIPSE = (60.0, 40.0, 12.0, 16.0)


def shifted_pair(disparity: int, brighter: int = 0) -> PreparedPair:
    """A random image, and the same seen from the right; a stripe of it a pixel farther away."""
    wide = np.random.default_rng(3).integers(0, 200, (80, 140, 3), dtype=np.uint8)
    left, right = wide[:, 10:130], wide[:, 10 + disparity : 130 + disparity].copy()
    right[36:40] = wide[36:40, 9 + disparity : 129 + disparity]
    k = kernel_sets.load("native")
    return PreparedPair.of(k, np.ascontiguousarray(left), right + np.uint8(brighter), np.inf, None, PAPER)


def brute_force(pair: PreparedPair, limits: tuple[int, int]) -> np.ndarray:
    """(3) over the ellipse's pixels: the d of the least sum of absolute differences in a window."""
    k = kernel_sets.load("native")
    left, right = (k.reduce_gray(image, 1).astype(int) for image in (pair.left, pair.right))
    x, y, minor, major = ELLIPSE
    found = []
    for v in range(int(y - major), int(y + major)):
        for u in range(int(x - minor), int(x + minor)):
            if ((u + 0.5 - x) / minor) ** 2 + ((v + 0.5 - y) / major) ** 2 > 1:
                continue
            here = left[v - 2 : v + 3, u - 2 : u + 3]
            costs = [
                np.abs(here - right[v - 2 : v + 3, u - d - 2 : u - d + 3]).sum()
                for d in range(limits[0], limits[1] + 1)
            ]
            found.append(limits[0] + int(np.argmin(costs)))
    return np.array(found)


@pytest.mark.parametrize("kernels", ["native", "reference"])
def test_disparity_is_the_mean_of_whole_pixels(kernels):
    """(3)-(5): plain sums of absolute differences of gray levels, whole pixels, their mean."""
    pair, limits = shifted_pair(7), limits_around(6.6, 1, PAPER)
    assert limits == (3, 11)  # nine candidates round 7
    found = measure_disparity(kernel_sets.load(kernels), pair, ELLIPSE, limits, PAPER)
    matched = brute_force(pair, limits)
    assert set(matched) >= {6, 7}
    assert found is not None
    assert found.disparity == pytest.approx(matched.mean(), abs=1e-6)


def test_brightness_changes_plain_sums():
    """Without a prefilter a brighter right image has other disparities; ours, by edges, has the same."""
    k = kernel_sets.load("native")
    pairs = [shifted_pair(7), shifted_pair(7, 40)]
    plain, ours = (
        [measure_disparity(k, pair, ELLIPSE, (3, 11), p) for pair in pairs] for p in (PAPER, Params())
    )
    assert plain[0] != plain[1]
    assert ours[0] == ours[1]


def follow_colors(scene, **choices) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frame by frame the filter's mean color, that of the model, and the model."""
    tracker = StereoHeadTracker(replace(PAPER, **choices), rig=scene.rig)
    tracker.init(scene.frames[0], scene.boxes[0])
    k, rows = kernel_sets.load("native"), []
    for frame in scene.frames[1:12]:
        tracker.update(frame)
        state = tracker._state
        mean = k.histogram_mean(state.learned_histogram, PAPER.color_space)
        rows.append((state.filter.color.copy(), mean, state.learned_histogram))
    colors, means, models = (np.array(each) for each in zip(*rows, strict=True))
    return colors, means, models


def test_the_gate_is_a_value_of_the_intersection(heads):
    """(2) is applied where (1) is at least the threshold itself: never at 1, always at 0. Ours is relative to
    the running mean.
    """
    scene = heads(0)
    *_, never = follow_colors(scene, min_intersection_to_learn=1.0, feedback=False)
    *_, always = follow_colors(scene, min_intersection_to_learn=0.0, feedback=False)
    assert (never == never[0]).all()
    assert (np.abs(np.diff(always, axis=0)).sum(axis=1) > 0).all()
    tracker = StereoHeadTracker(PAPER, rig=scene.rig)
    tracker.init(scene.frames[0], scene.boxes[0])
    state = tracker._state._replace(mean_intersection=0.6)
    assert state.min_intersection_to_learn(PAPER) == 0.5
    assert state.min_intersection_to_learn(Params(min_intersection_to_learn=0.5)) == 0.3


def test_the_measured_color_is_that_of_the_updated_model(heads):
    """(7): mu is the mean of M, updated, not of the candidate. Unfused the filter has just that, fused the
    histogram is shifted to the filter's mean, up to what comes to lie beyond the axes' ends.
    """
    scene = heads(0)
    colors, means, _ = follow_colors(scene, fuse=False, feedback=False)
    np.testing.assert_allclose(colors, means, rtol=1e-12)
    frozen, _, _ = follow_colors(scene, fuse=False, feedback=False, min_intersection_to_learn=1.0)
    np.testing.assert_array_equal(frozen, frozen[:1].repeat(len(frozen), 0))
    colors, means, _ = follow_colors(scene)
    np.testing.assert_allclose(colors, means, atol=1e-4)


def test_given_colors_are_the_first_model(heads):
    """The model of given samples is what is searched for, whatever the first box holds."""
    scene = heads(0)
    given = ((5, 3.0), (700, 1.0))
    tracker = StereoHeadTracker(rig=scene.rig, head_colors=given)
    tracker.init(scene.frames[0], scene.boxes[0])
    model = tracker._state.model
    assert np.flatnonzero(model).tolist() == [5, 700]
    np.testing.assert_allclose(model[[5, 700]], [0.75, 0.25])


def test_follows_a_head_in_steady_light(heads, follow):
    """In light that stays the same the printed form holds a head through the first second."""
    scene = heads(0, 31, light=0.0)
    tracks = follow(StereoHeadTracker(PAPER, rig=scene.rig), scene.frames, scene.boxes[0])
    assert min(track.box.iou(box) for track, box in zip(tracks, scene.boxes, strict=True)) > 0.5


@pytest.mark.parametrize("params", [PAPER, Params(prefilter=False)], ids=["printed", "without a prefilter"])
def test_wide_pairs_are_followed(params, heads, follow):
    """Where cells are so large that the matching window of the prefilter would be too wide for gray levels,
    a head is followed all the same.
    """
    scene, times = heads(0, 31, light=0.0), 8
    camera = scene.rig.intrinsics
    height, width = scene.frames[0].color.shape[:2]
    focal, center = (times * camera.fx, times * camera.fy), (times * camera.cx, times * camera.cy)
    wide = Intrinsics(*focal, *center, width=times * width, height=times * height)
    tracker = StereoHeadTracker(params, rig=StereoRig(wide, scene.rig.baseline))

    def larger(image: np.ndarray) -> np.ndarray:
        return np.kron(image, np.ones((times, times, 1), np.uint8))

    pairs = [Frame(larger(each.color), right=larger(each.right)) for each in scene.frames[:3]]
    boxes = [Box(*(times * side for side in box)) for box in scene.boxes[:3]]
    tracks = follow(tracker, pairs, boxes[0])
    assert {track.status for track in tracks} == {Status.TRACKED}
    assert min(track.box.iou(box) for track, box in zip(tracks, boxes, strict=True)) > 0.5
