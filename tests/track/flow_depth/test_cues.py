# SPDX-License-Identifier: MIT
"""That flow and disparity around the target are what was drawn, in the region that is measured."""

import dataclasses

import cv2
import numpy as np
import pytest
from tricue import FlowDepthTracker
from tricue.track.flow_depth.cues import measure
from tricue.track.flow_depth.initial_disparity import find_initial_disparity
from tricue.track.flow_depth.reduced_frame import ReducedFrame

P = FlowDepthTracker.Params()
H, W = 60, 100
REGION = (20, 10, 70, 50)
INNER = np.s_[8:-8, 8:-8]


def wide(seed: int = 0) -> np.ndarray:
    """Clouds of gray with fine grain, 40 columns wider than a picture."""
    rng = np.random.default_rng(seed)
    coarse = cv2.resize(rng.normal(0, 40, (15, 35)), (W + 40, H), interpolation=cv2.INTER_CUBIC)
    fine = cv2.GaussianBlur(rng.normal(0, 60, (H, W + 40)), (0, 0), 1.2)
    return np.clip(coarse + fine + 128, 0, 255).astype(np.uint8)


WIDE = wide()


def pair(disparity: int, shift: int = 0) -> ReducedFrame:
    """All at one disparity, moved to the right."""
    first = 20 - shift
    left, right = (WIDE[:, at : at + W].copy() for at in (first, first + disparity))
    return ReducedFrame(left, right, None, 1)


def mapped(frame: ReducedFrame, disparity: float | np.ndarray) -> ReducedFrame:
    """The same, of a depth camera."""
    return frame._replace(right=None, disparity=np.broadcast_to(np.float32(disparity), (H, W)).copy())


@pytest.mark.parametrize("levels", [1, 2])
def test_flow_is_what_moved(levels, kernels):
    """A picture that moves a pixel to the right has u = 1 and v = 0, in the median to 0.1, at more than a
    third of the cells.
    """
    p = dataclasses.replace(P, flow_levels=levels, sigma=1.5 if levels == 1 else P.sigma)
    cues = measure(kernels, pair(5), pair(5, 1), REGION, 5, p)
    for found, true in zip(cues.flow, (1, 0), strict=True):
        assert found.values.shape == found.weights.shape == cues.shape == (40, 50)
        assert np.isfinite(found.values[INNER]).mean() > 0.33
        assert np.nanmedian(found.values[INNER]) == pytest.approx(true, abs=0.1)


@pytest.mark.parametrize("value", [0, 128, 255])
def test_nothing_moves_in_a_uniform_image(value, kernels):
    """From a picture to a black, gray or white image, and back, there is no flow."""
    one = pair(5)
    none = one._replace(gray=np.full_like(one.gray, value))
    for before, now in ((one, none), (none, one), (none, none)):
        for found in measure(kernels, before, now, REGION, 5, P).flow:
            assert np.isnan(found.values).all()
            assert found.values.shape == found.weights.shape == (40, 50)


@pytest.mark.parametrize("expected", [3, 5, 7.5])
def test_disparity_is_what_was_drawn(expected, kernels):
    """Around an expected disparity that is off, the true one is measured, in the median to 0.1 cells."""
    found = measure(kernels, None, pair(5), REGION, expected, P).disparity
    assert np.isfinite(found.values[INNER]).mean() > 0.5
    assert np.nanmedian(found.values[INNER]) == pytest.approx(5, abs=0.1)
    assert found.weights.min() >= 0


def test_depth_is_taken_as_it_is(kernels):
    """A depth camera's disparities are those of the region, all of one weight, whatever is expected."""
    disparity = np.arange(H * W, dtype=np.float32).reshape(H, W)
    disparity[20, 30] = np.nan
    found = measure(kernels, None, mapped(pair(5), disparity), REGION, 99, P).disparity
    np.testing.assert_array_equal(found.values, disparity[10:50, 20:70])
    assert (found.weights == 1).all()


@pytest.mark.parametrize(
    ("cues", "before", "maps"),
    [
        (("flow", "disparity"), True, 3),
        (("flow",), True, 2),
        (("disparity",), True, 1),
        (P.cues, False, 1),
        (("flow",), False, 0),
    ],
    ids=str,
)
def test_only_chosen_cues_are_measured(cues, before, maps, kernels):
    """Flow needs a frame before, and each cue has to be chosen; without disparity it is NaN everywhere."""
    frame = pair(5)
    found = measure(kernels, frame if before else None, frame, REGION, 5, dataclasses.replace(P, cues=cues))
    assert len(found.maps) == maps
    assert found.disparities().shape == (40, 50)
    assert np.isnan(found.disparities()).all() == ("disparity" not in cues)


@pytest.mark.parametrize("disparity", [-2, 0, 4, 9, 17])
def test_a_start_finds_its_disparity(disparity, kernels):
    """Of a pair the disparity is found without any expectation, to half a cell, below 0 too; of a depth
    camera exactly.
    """
    assert find_initial_disparity(kernels, pair(disparity), REGION) == pytest.approx(disparity, abs=0.5)
    assert find_initial_disparity(kernels, mapped(pair(4), disparity), REGION) == disparity


@pytest.mark.parametrize("share", [0.75, 0.9])
def test_a_start_takes_what_most_has(share, kernels):
    """Of two disparities in the region it is that of the larger part, not something between."""
    left, right = pair(12)[:2]
    split = 20 + round(50 * share)
    far = pair(4)
    left[:, split:], right[:, split - 4 :] = far.gray[:, split:], far.right[:, split - 4 :]
    right[:, split - 12 : split - 4] = far.right[:, split - 12 : split - 4]
    both = ReducedFrame(left, right, None, 1)
    assert find_initial_disparity(kernels, both, REGION) == pytest.approx(12, abs=0.5)
    depths = np.where(np.arange(W) < split, 12.0, 4.0)
    assert find_initial_disparity(kernels, mapped(both, depths), REGION) == 12


NOISE = np.random.default_rng(1).integers(0, 256, (2, H, W)).astype(np.uint8)
NOTHING = {
    "no texture": ReducedFrame(np.full((H, W), 90, np.uint8), np.full((H, W), 90, np.uint8), None, 1),
    "noise": ReducedFrame(NOISE[0], NOISE[1], None, 1),
    "no depth": mapped(pair(5), np.nan),
    "all depths": mapped(pair(5), np.linspace(0, 60, W)),
    "11 cells": mapped(pair(5), np.where(np.arange(H * W).reshape(H, W) - (20 * W + 30) < 11, 5, np.nan)),
}
NOTHING["11 cells"].disparity[:20] = np.nan
NOTHING["11 cells"].disparity[20, :30] = np.nan


@pytest.mark.parametrize("name", NOTHING)
def test_a_start_on_nothing_has_none(name, kernels):
    """Without texture, in noise, without depth or where all depths are different there is no disparity."""
    assert find_initial_disparity(kernels, NOTHING[name], REGION) is None


@pytest.mark.parametrize("region", [(5, 5, 5, 20), (5, 5, 20, 5), (0, 0, 0, 0)], ids=str)
def test_an_empty_region_has_none(region, kernels):
    """In an empty region there is no disparity, of a pair and of a depth camera."""
    assert find_initial_disparity(kernels, pair(5), region) is None
    assert find_initial_disparity(kernels, mapped(pair(5), 5), region) is None


def test_a_start_searches_where_a_verged_pair_has_it(kernels):
    """Of a pair whose disparities are 20 too small a target of 4 is found at -16, outside the range of a
    parallel pair.
    """
    frame = pair(-16)._replace(offset=20.0)
    assert find_initial_disparity(kernels, frame, REGION) == pytest.approx(-16, abs=0.5)
    assert find_initial_disparity(kernels, frame._replace(offset=0.0), REGION) is None
