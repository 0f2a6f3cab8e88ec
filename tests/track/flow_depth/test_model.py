# SPDX-License-Identifier: MIT
"""That the model's peaks and densities are those of the target, and of its surround."""

import dataclasses

import numpy as np
import pytest
from tricue import FlowDepthTracker
from tricue.track.flow_depth.blocks import TARGET_BLOCK, Blocks
from tricue.track.flow_depth.cues import CueMap, Cues
from tricue.track.flow_depth.model import ExpectedPeak, TargetModel, estimate_model

P = FlowDepthTracker.Params()
H, W = 40, 60
WINDOW = (20.0, 10.0, 40.0, 30.0)
INSIDE = np.s_[10:30, 20:40]
OURS, AROUND = (0.9, -0.4, 12.0), (0.0, 0.0, 7.0)  # u, v, d
EXPECTED = [ExpectedPeak(0.7, 100, 3), ExpectedPeak(0.0, 100, 3), ExpectedPeak(11.5, 100, 6)]


def cue_map(ours: float, around: float, seed: int, spread: float = 0.05) -> CueMap:
    """One observation of a target in the window and of its surround, with noise, all of one weight."""
    values = np.full((H, W), around, np.float32)
    values[INSIDE] = ours
    values += np.random.default_rng(seed).normal(0, spread, values.shape).astype(np.float32)
    return CueMap(values, np.ones_like(values))


def cues_of(*pairs: tuple[float, float]) -> Cues:
    """The three observations of targets and surrounds."""
    u, v, d = (cue_map(*each, seed) for seed, each in enumerate(pairs))
    return Cues((0, 0, W, H), (u, v), d)


CUES = cues_of(*zip(OURS, AROUND, strict=True))


def blocks_of(*window: float) -> Blocks:
    """One block, the target's."""
    none = np.zeros(1, np.int64)
    own = np.array([TARGET_BLOCK])
    return Blocks(np.array([window]), (0.0, 0.0), 1.0, own, none, none, np.array([True]), own, none)


OWN, EVERYWHERE = blocks_of(*WINDOW), blocks_of(0.0, 0.0, W, H)


def model_of(
    k, cues=CUES, expected=EXPECTED, blocks=OWN, same_depth=None, before=None, **changes
) -> TargetModel:
    """The model of the cues in the window."""
    p = dataclasses.replace(P, **changes)
    return estimate_model(k, cues, expected, WINDOW, blocks, same_depth, before, p)


def test_peaks_are_the_targets(kernels):
    """The representative velocity and disparity are the target's to a fifth of a bin, not the surround's."""
    found = model_of(kernels)
    for peak, true, at in zip(found.peaks, OURS, EXPECTED, strict=True):
        assert peak == pytest.approx(true, abs=0.2 * 2 * at.half_range / P.bins)


def test_densities_are_densities(kernels):
    """The target's are of sum 1, the alternatives above 0 everywhere and of sum 1 at most, one a bin."""
    found = model_of(kernels)
    assert len(found.densities) == len(found.alternatives) == len(found.ranges) == 3
    for density, alternative in zip(found.densities, found.alternatives, strict=True):
        assert density.shape == alternative.shape == (P.bins,)
        assert density.sum() == pytest.approx(1)
        assert density.min() >= 0
        assert alternative.min() > 0
        assert alternative.sum() <= 1 + 1e-9
    assert found.ranges == tuple((at.value - at.half_range, at.value + at.half_range) for at in EXPECTED)


def test_each_density_is_highest_where_its_own_are(kernels):
    """In the target's bin the target's density is the larger, in that of its surround the other one."""
    found = model_of(kernels)
    for i, (low, high) in enumerate(found.ranges):
        bins = [int((value - low) / (high - low) * P.bins) for value in (OURS[i], AROUND[i])]
        assert found.densities[i][bins[0]] > 5 * found.alternatives[i][bins[0]]
        assert found.densities[i][bins[1]] < 0.2 * found.alternatives[i][bins[1]]


def test_without_surround_the_alternative_is_uniform(kernels):
    """With ``surround_weight=0``, and without any surround, the alternative is uniform, as printed."""
    everywhere = [model_of(kernels, blocks=blocks) for blocks in (EVERYWHERE, None)]
    for found in (model_of(kernels, surround_weight=0), *everywhere):
        for alternative in found.alternatives:
            np.testing.assert_allclose(alternative, 1 / P.bins, rtol=1e-12)


@pytest.mark.parametrize("smoothing", [0.3, 1.5, 8])
@pytest.mark.parametrize("bins", [8, 48])
def test_smoothing_may_be_wider_than_the_range(bins, smoothing, kernels):
    """However few bins there are and however they are smoothed, alternatives have one value each and lose
    nothing within the range: a surround in its middle bin stays highest there.
    """
    middle = cues_of(*zip(OURS, (0.7, 0.0, 11.5), strict=True))
    for alternative in model_of(kernels, middle, bins=bins, smoothing=smoothing).alternatives:
        assert alternative.shape == (bins,)
        assert abs(int(alternative.argmax()) - bins // 2) <= 1
        assert alternative.sum() <= 1 + 1e-9


def test_flow_is_that_of_the_visible(kernels):
    """Cells that something nearer hides don't count for the velocity, though they do for the disparity."""
    cues = cues_of((0.9, 0.0), (-0.4, 0.0), (12.0, 7.0))
    hider = np.s_[10:30, 20:33]
    for each, value in zip(cues.maps, (-1.5, 1.5, 16.0), strict=True):
        each.values[hider] = value
    u, v, d = model_of(kernels, cues, same_depth=(12.0, 1.0)).peaks
    assert (u, v) == pytest.approx((0.9, -0.4), abs=0.05)
    assert d == pytest.approx(16, abs=0.13)  # half a bin
    assert model_of(kernels, cues).peaks[0] == pytest.approx(-1.5, abs=0.05)


def test_what_is_expected_wins_over_what_is_more(kernels):
    """A narrow spread takes the lower peak that is where the target is expected."""
    cues = cues_of((0.9, 0.0), (-0.4, 0.0), (12.0, 7.0))
    cues.maps[2].values[10:30, 20:33] = 16.0
    narrow = [*EXPECTED[:2], ExpectedPeak(11.5, 0.5, 6)]
    assert model_of(kernels, cues).peaks[2] == pytest.approx(16, abs=0.13)
    assert model_of(kernels, cues, narrow).peaks[2] == pytest.approx(12, abs=0.25)


def test_without_observations_it_is_as_expected(kernels):
    """Without any observation the peak is the expected value, and no density is there to find pixels by."""
    blind = Cues(CUES.region, None, CueMap(np.full((H, W), np.nan, np.float32), np.ones((H, W), np.float32)))
    found = model_of(kernels, blind, EXPECTED[2:])
    assert found.peaks == pytest.approx((11.5,))
    assert not found.densities[0].any()
    np.testing.assert_allclose(found.alternatives[0], 1 / P.bins)


def test_memory_blends_the_densities(kernels):
    """Densities are mixed with those before, moved to the new peak, by ``density_memory``, and have sum 1.
    Without memory, or before, they are the new ones alone.
    """
    before = model_of(kernels)
    wider = Cues((0, 0, W, H), (cue_map(1.4, 0, 5, 0.4), CUES.maps[1]), CUES.disparity)
    alone = model_of(kernels, wider, density_memory=0)
    both = model_of(kernels, wider, before=before, density_memory=0.8)
    assert both.peaks == alone.peaks
    assert both.densities[0].sum() == pytest.approx(1)
    for moved in (before.densities[0], alone.densities[0]):
        assert both.densities[0].argmax() == pytest.approx(alone.densities[0].argmax(), abs=2)
        assert moved.shape == both.densities[0].shape
    assert alone.densities[0].max() < both.densities[0].max() < before.densities[0].max()
    np.testing.assert_array_equal(
        model_of(kernels, wider, before=before, density_memory=0).densities, alone.densities
    )


@pytest.mark.parametrize("scale", [0.3, 1 / 0.3])
def test_memory_keeps_disparities(scale, kernels):
    """The density before, of a stereo pair, stays at its disparities and as wide when a depth camera's frame
    comes next, whose bins have another width; and the other way round.
    """
    expected = [*EXPECTED[:2], ExpectedPeak(11.5, 100, 6 * scale)]
    other = CUES._replace(disparity_scale=scale)
    before = model_of(kernels)
    after = model_of(kernels, other, expected, before=before, density_memory=0.99)
    assert mean_and_deviation(after) == pytest.approx(mean_and_deviation(before), abs=0.1)


def mean_and_deviation(model: TargetModel) -> tuple[float, float]:
    """Those of the disparity's density, cells."""
    (low, high), density = model.ranges[2], model.densities[2]
    middles = low + (np.arange(P.bins) + 0.5) * (high - low) / P.bins
    mean = float(middles @ density)
    return mean, float(np.sqrt((middles - mean) ** 2 @ density))
