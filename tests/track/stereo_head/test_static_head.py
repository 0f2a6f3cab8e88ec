# SPDX-License-Identifier: MIT
"""Noise measured from a head at rest, and color models of samples, against known ones."""

import numpy as np
import pytest
from tricue import Frame, StereoHeadTracker
from tricue.scenes import head, static_head
from tricue.track.stereo_head.color_samples import count_colors, head_colors
from tricue.track.stereo_head.static_head import measure_static_head, split_noise

Params = StereoHeadTracker.Params


@pytest.mark.parametrize(("noise", "drift"), [(2.0, 0.5), (1.0, 0.0), (0.5, 1.0)])
def test_noise_and_drift_are_told_apart(noise, drift):
    """A random walk seen through noise has both deviations back, to a tenth."""
    rng = np.random.default_rng(1)
    found = [
        split_noise(np.cumsum(drift * rng.standard_normal(400)) + noise * rng.standard_normal(400))
        for _ in range(30)
    ]
    measured = np.sqrt(np.mean(np.square(found), axis=0))
    assert measured[0] == pytest.approx(noise, rel=0.1)
    assert measured[1] == pytest.approx(drift, rel=0.15, abs=0.1)


def test_noise_on_a_smooth_swing_is_not_negative():
    """Light that swings smoothly is drift; the noise on it stays what it is."""
    rng = np.random.default_rng(2)
    series = 20 * np.sin(np.arange(300) / 25) + 0.3 * rng.standard_normal(300)
    noise, drift = split_noise(series)
    assert noise == pytest.approx(0.3, rel=0.1)
    assert drift == pytest.approx(20 / 25 / 2**0.5, rel=0.2)


def test_a_noisier_camera_has_noisier_measurements():
    """Colors and intersection of a head at rest deviate more with six times the noise."""
    quiet, loud = (
        measure_static_head(scene.frames, scene.boxes[0], scene.rig, Params.paper())
        for scene in (static_head(3, 30, noise=noise) for noise in (1.0, 6.0))
    )
    assert (loud.colors.std(axis=0) > 1.5 * quiet.colors.std(axis=0)).all()
    assert loud.intersections.std() > 1.2 * quiet.intersections.std()
    assert quiet.frames == len(quiet.positions) == 29
    assert quiet.colors.shape == (29, 3)
    assert quiet.noise["intersection_noise"] < loud.noise["intersection_noise"]


@pytest.mark.parametrize("seed", [0, 2, 4])
def test_a_head_that_moves_is_told_from_a_noisy_one(seed):
    """However noisy the camera is, and in changing light, a head at rest doesn't seem to move."""
    moving, *still = head(seed, 60), static_head(seed, 60, noise=6.0), static_head(seed, 60, light=0.3)
    assert measure_static_head(moving.frames, moving.boxes[0], moving.rig).moves
    assert not any(measure_static_head(each.frames, each.boxes[0], each.rig).moves for each in still)


def test_a_head_that_is_always_at_the_same_place_does_not_move(rendered):
    """A pair repeated has one position, whose mean is rounded."""
    scene = rendered(static_head, 4, 22)
    found = measure_static_head([scene.frames[0]] * 20, scene.boxes[0], scene.rig)
    assert (found.positions == found.positions[0]).all()
    assert not found.moves


def test_positions_are_those_of_the_head():
    """The mean position is within 2 % of the true one, and so is the disparity, by the rig."""
    scene = static_head(4, 20, distance=1.5, aside=(0.3, 0.1))
    found = measure_static_head(scene.frames, scene.boxes[0], scene.rig)
    off = found.positions.mean(axis=0) - scene.positions[0]
    assert np.linalg.norm(off) < 0.02 * np.linalg.norm(scene.positions[0])
    assert found.disparity_noise(scene.rig, float(scene.positions[0, 2])) < 1


def test_a_recording_that_is_too_short_is_refused():
    """Ten measured pairs are the least, and no frames at all are told, too."""
    scene = static_head(4, 8)
    with pytest.raises(ValueError, match=r"frames: expected a head at rest, .* got 7 of 7"):
        measure_static_head(scene.frames, scene.boxes[0], scene.rig)
    ten = static_head(4, 10)
    with pytest.raises(ValueError, match=r"10 or more stereo pairs after the first, .* got 9 of 9"):
        measure_static_head(ten.frames, ten.boxes[0], ten.rig)
    with pytest.raises(ValueError, match="frames: expected at least 11 stereo pairs, got none"):
        measure_static_head([], scene.boxes[0], scene.rig)


@pytest.mark.parametrize(("blank", "is_enough"), [(10, True), (12, False)])
def test_half_of_the_frames_are_to_be_measured(blank, is_enough, rendered):
    """Frames without a disparity are left out, and counted; more than half of them are too many."""
    scene = rendered(static_head, 4, 22)
    frames = [
        Frame(frame.color, right=frame.right * 0) if 0 < i <= blank else frame
        for i, frame in enumerate(scene.frames)
    ]
    if is_enough:
        found = measure_static_head(frames, scene.boxes[0], scene.rig)
        assert (found.frames, len(found.positions)) == (21, 11)
    else:
        with pytest.raises(ValueError, match="in half of them, got 9 of 21"):
            measure_static_head(frames, scene.boxes[0], scene.rig)


def test_ten_frames_are_enough(rendered):
    """Ten measured pairs after the first are the least."""
    scene = rendered(static_head, 4, 22)
    assert len(measure_static_head(scene.frames[:11], scene.boxes[0], scene.rig).positions) == 10


def test_a_measurement_is_as_noisy_as_the_parameters_say(rendered):
    """The deviations of color and intersection are the parameters, squared in the first covariance."""
    scene = rendered(static_head, 4, 22)
    tracker = StereoHeadTracker(rig=scene.rig, color_noise=(3.0, 4.0, 5.0), intersection_noise=0.2)
    tracker.init(scene.frames[0], scene.boxes[0])
    np.testing.assert_allclose(np.diag(tracker._state.filter.covariance)[3:7], [9, 16, 25, 0.04])


def test_the_model_of_samples_counts_their_pixels():
    """Only marked pixels count, each the same; hair and skin are mixed by their share."""
    rng = np.random.default_rng(5)
    images = rng.integers(0, 256, (2, 9, 8, 3), dtype=np.uint8)
    masks = rng.random((2, 9, 8)) < 0.4
    p = Params(bins=(4, 4, 3), max_chroma=32)
    found = count_colors(zip(images, masks, strict=True), p)
    expected = np.zeros(48)
    for b, g, r in images[masks].astype(int).tolist():
        chroma = [min(max(c, -32), 31) + 32 for c in (b - g, g - r)]
        expected[(chroma[0] * 4 // 64 * 4 + chroma[1] * 4 // 64) * 3 + (b + g + r) * 3 // 766] += 1
    np.testing.assert_allclose(found, expected / masks.sum(), rtol=1e-12)
    model = np.zeros(48)
    for index, weight in head_colors([(images[0], masks[0])], [(images[1], masks[1])], 0.25, p):
        model[index] = weight
    parts = [count_colors([(image, mask)], p) for image, mask in zip(images, masks, strict=True)]
    np.testing.assert_allclose(model, 0.75 * parts[0] + 0.25 * parts[1], atol=2e-5)


def test_samples_without_a_marked_pixel_are_refused():
    """No pixel, or a mask of another size, is a ValueError that names the samples."""
    image = np.zeros((4, 5, 3), np.uint8)
    with pytest.raises(ValueError, match="samples: expected at least one marked pixel"):
        count_colors([(image, np.zeros((4, 5), np.bool_))], Params())
    with pytest.raises(ValueError, match=r"samples: expected a mask of shape \(4, 5\), got \(5, 4\)"):
        count_colors([(image, np.zeros((5, 4), np.bool_))], Params())
    with pytest.raises(ValueError, match="hair_weight: expected a share"):
        head_colors([], [], 1.5)


@pytest.mark.parametrize("level", [1, 255])
def test_a_mask_of_numbers_is_refused(level):
    """A mask of 0 and 255, as image files hold it, would index pixels instead of marking them."""
    image, mask = np.zeros((4, 5, 3), np.uint8), np.full((4, 5), level, np.uint8)
    with pytest.raises(TypeError, match="samples: expected a mask of True and False, got uint8"):
        count_colors([(image, mask)], Params())


@pytest.mark.parametrize("meters", [0.0, -1.5, float("nan")])
def test_a_distance_that_no_head_has_is_refused(meters):
    """A disparity's error is measured against a distance above 0."""
    scene = static_head(0, 12)
    found = measure_static_head(scene.frames, scene.boxes[0], scene.rig)
    with pytest.raises(ValueError, match="distance: expected"):
        found.disparity_noise(scene.rig, meters)
