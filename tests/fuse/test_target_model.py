# SPDX-License-Identifier: MIT
"""The target's densities, those of its surround, and its velocity and disparity."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from tricue import _core, reference
from tricue.kernels import Kernels

H, W, BINS = 40, 60, 48
OURS, AROUND = (0.9, -0.4, 12.0), (0.0, 0.3, 7.0)
EXPECTED = [(0.7, 100.0, 3.0), (0.0, np.inf, 3.0), (11.5, 5.0, 6.0)]
BLOCKS = np.array([[0.0, 0, 10, 20], [10, 0, 20, 20], [20, 0, 30, 20]])
PLACE = (1.0, 120.0, 60.0, 100.0, 50.0)
GRID = (BLOCKS, PLACE)
RULES = (BINS, 1.5, 0.05, 0.8, 0.8)


def case(seed: int = 0, cues: int = 3, **changes: Any) -> dict[str, Any]:
    """A target in the middle, in two of three blocks; some values are missing, some weights are none."""
    rng = np.random.default_rng(seed)
    inside = np.zeros((H, W), np.bool_)
    inside[10:30, 20:40] = True
    maps = []
    for ours, around in list(zip(OURS, AROUND, strict=True))[:cues]:
        values = np.where(inside, ours, around) + rng.normal(0, 0.1, (H, W))
        values[rng.random((H, W)) < 0.1] = rng.choice([np.nan, np.inf, -2e6, 1e6])
        weights = rng.random((H, W))
        weights[rng.random((H, W)) < 0.05] = rng.choice([0, -1, np.nan, np.inf])
        maps.append((values.astype(np.float32), weights.astype(np.float32)))
    return {
        "maps": maps,
        "expected": EXPECTED[:cues],
        "window": (20.0, 10.0, 40.0, 30.0),
        "blocks": (GRID, np.array([1, 1, 2]), np.array([3, 1, 3])),
        "depth": (12.0, 1.0),
        "before": None,
        "rules": RULES,
        **changes,
    }


def former(seed: int, cues: int) -> tuple[np.ndarray, list[float], list[float]]:
    """A model of the frame before."""
    densities = np.random.default_rng(seed).random((cues, BINS)) ** 4
    lows = [value - half for value, _, half in EXPECTED[:cues]]
    return densities / densities.sum(axis=1, keepdims=True), lows, [each + 2.5 for each in lows]


@given(st.integers(0, 2**32), st.integers(1, 3), st.booleans(), st.booleans(), st.booleans())
def test_twin_gives_the_same(seed: int, cues: int, blocks: bool, depth: bool, before: bool) -> None:
    """Native and reference agree: sums of 2400 float64 in another order differ by 2400 EPS, 5e-13 of them,
    and the peak is the top of a parabola over three of them, where a bin is at least 0.125 wide.
    """
    arguments = case(seed, cues, before=former(seed, cues) if before else None)
    if not blocks:
        arguments["blocks"] = None
    if not depth:
        arguments["depth"] = None
    ours, theirs = (each.target_model(**arguments) for each in (_core, reference))
    for one, other in zip(ours, theirs, strict=True):
        assert one.dtype == other.dtype == np.float64
        assert_allclose(one, other, rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize("width", [0, 1, 2, 3, 4, 5, 7, 23])
def test_twin_gives_the_same_in_rows_of_any_length(width: int) -> None:
    """They agree as above on rows of no pixels, fewer than four, as many and more, cut from wider planes."""
    arguments = case(width, before=former(width, 3))
    arguments["maps"] = [tuple(plane[:, 18 : 18 + width] for plane in each) for each in arguments["maps"]]
    arguments["blocks"] = ((BLOCKS, (1.0, 120.0, 60.0, 118.0, 50.0)), *arguments["blocks"][1:])
    arguments["window"] = (2.0, 10.0, 22.0, 30.0)
    ours, theirs = (each.target_model(**arguments) for each in (_core, reference))
    for one, other in zip(ours, theirs, strict=True):
        assert_allclose(one, other, rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize("window", [(23.0, 11.0, 38.0, 29.0), (-5.0, -5.0, 99.0, 99.0)])
def test_histograms_are_those_of_the_kernel(window: Any, kernels: Kernels) -> None:
    """Without memory the density is the target_distribution of the weighted_histogram of the target's pixels,
    to the last bit, of flow only at the target's depth; the peak is its value.
    """
    a = case(window=window)
    densities, _, peaks = kernels.target_model(**a)
    target = np.zeros((H, W), np.uint8)
    target[10:30, 20:40] = 1
    with np.errstate(invalid="ignore"):
        near = (~(np.abs(a["maps"][2][0] - np.float32(12)) > np.float32(1))).astype(np.uint8)
    for i, ((values, weights), (value, deviation, half)) in enumerate(zip(a["maps"], EXPECTED, strict=True)):
        counted = target if i == 2 else target & near
        low, high = value - half, value + half
        histogram = kernels.weighted_histogram(values, weights, window, low, high, BINS, counted)
        width = 2 * half / BINS
        density, peak = kernels.target_distribution(histogram, 1.5, 0.05, BINS / 2, deviation / width)
        np.testing.assert_array_equal(densities[i], density)
        assert peaks[i] == low + peak * width


def test_finds_what_was_drawn(kernels: Kernels) -> None:
    """Peaks are the target's to half a bin; densities and alternatives are highest at their own values."""
    densities, alternatives, peaks = kernels.target_model(**case())
    for i, (value, _, half) in enumerate(EXPECTED):
        width = 2 * half / BINS
        assert peaks[i] == pytest.approx(OURS[i], abs=width / 2)
        ours, around = (int((each[i] - value + half) / width) for each in (OURS, AROUND))
        assert densities[i, ours] > 2 * alternatives[i, ours]
        assert alternatives[i, around] > 2 * densities[i, around]
    assert_allclose(densities.sum(axis=1), 1)
    assert alternatives.min() >= 0.2 / BINS * (1 - 1e-12)
    assert (alternatives.sum(axis=1) <= 1 + 1e-12).all()


def test_only_trusted_target_blocks_count(kernels: Kernels) -> None:
    """Without a trusted target block nothing is read: the expected peaks, densities of zeros, and
    alternatives of everything.
    """
    for states, trusted in (
        (np.array([0, 2, 2]), np.array([3, 3, 3])),
        (np.ones(3, np.int64), np.zeros(3, np.int64)),
    ):
        densities, alternatives, peaks = kernels.target_model(**case(blocks=(GRID, states, trusted)))
        assert not densities.any()
        assert peaks == pytest.approx([value for value, _, _ in EXPECTED])
        assert alternatives.max() > 5 / BINS


@pytest.mark.parametrize("changes", [{"blocks": None}, {"rules": (BINS, 1.5, 0.05, 0.8, 0.0)}], ids=str)
def test_without_surround_the_alternative_is_uniform(changes: dict[str, Any], kernels: Kernels) -> None:
    """Where all pixels are the target's, and where the surround has no weight."""
    assert_allclose(kernels.target_model(**case(**changes))[1], 1 / BINS, rtol=1e-12)


def test_memory_mixes_in_what_was(kernels: Kernels) -> None:
    """The density before, moved to the new peak, has the weight of the memory: a peak of one bin stays where
    the target is, as high as it was, less what the new one takes.
    """
    a = case(rules=(BINS, 1.5, 0.05, 0.5, 0.8))
    alone, _, peaks = kernels.target_model(**a)
    width = 6.0 / BINS
    before = np.zeros((3, BINS))
    before[:, 10] = 1
    lows = [value - half for value, _, half in EXPECTED]
    places = [low + 10.0 * 2 * half / BINS for low, (_, _, half) in zip(lows, EXPECTED, strict=True)]
    both, _, same = kernels.target_model(**{**a, "before": (before, lows, places)})
    np.testing.assert_array_equal(same, peaks)
    assert_allclose(both.sum(axis=1), 1)
    at = (peaks[0] - lows[0]) / width  # bins, between two
    low = int(at)
    share = at - low
    assert both[0, low] - alone[0, low] / 2 == pytest.approx((1 - share) / 2, abs=1e-9)
    assert both[0, low + 1] - alone[0, low + 1] / 2 == pytest.approx(share / 2, abs=1e-9)


def test_order_of_pixels_changes_nothing(kernels: Kernels) -> None:
    """Mirrored pictures with mirrored places give the same, to rounding."""
    a = case()
    mirrored = [tuple(np.ascontiguousarray(plane[:, ::-1]) for plane in each) for each in a["maps"]]
    blocks = ((np.array([[0.0, 0, 20, 20]]), PLACE), np.array([1]), np.array([1]))
    for one, other in zip(
        kernels.target_model(**{**a, "blocks": blocks}),
        kernels.target_model(**{**a, "blocks": blocks, "maps": mirrored}),
        strict=True,
    ):
        assert_allclose(one, other, rtol=1e-9, atol=1e-10)


BAD: list[tuple[dict[str, Any], str]] = [
    ({"maps": []}, "maps: expected 1 to 3, got 0"),
    ({"expected": EXPECTED[:2]}, "expected: expected 3, as many as maps, got 2"),
    ({"maps": [*case()["maps"][:2], (np.zeros((H, 2), np.float32),) * 2]}, "maps: expected shape"),
    ({"expected": [*EXPECTED[:2], (1.0, 0.0, 1.0)]}, "expected: expected deviations above 0, got 0"),
    ({"expected": [*EXPECTED[:2], (1.0, 1.0, 0.0)]}, "high: expected a finite number above low"),
    ({"rules": (1, 1.5, 0.05, 0.8, 0.8)}, "bins: expected 2 to 65536, got 1"),
    ({"rules": (BINS, 0.0, 0.05, 0.8, 0.8)}, "smoothing: expected a number above 0, got 0"),
    ({"rules": (BINS, 1.5, 1.0, 0.8, 0.8)}, "min_prominence: expected"),
    ({"rules": (BINS, 1.5, 0.05, 1.0, 0.8)}, r"density_memory: expected a number in \[0, 1\), got 1"),
    ({"rules": (BINS, 1.5, 0.05, 0.8, -1.0)}, r"surround_weight: expected a number in \[0, 1\), got -1"),
    ({"blocks": (GRID, np.zeros(2, np.int64), np.zeros(3, np.int64))}, "states: expected 3 numbers"),
    (
        {"blocks": (GRID, np.zeros(3, np.int64), np.zeros(2, np.int64))},
        "trusted: expected 3 numbers",
    ),
    ({"before": (np.zeros((3, 5)), [0.0] * 3, [0.0] * 3)}, "before: expected"),
    ({"before": (np.zeros((3, BINS)), [0.0] * 2, [0.0] * 3)}, "before: expected 3 lows and peaks, got 2"),
    ({"before": (np.zeros((3, BINS)), [0.0] * 3, [0.0] * 2)}, "before: expected 3 lows and peaks, got 2"),
    ({"window": (0.0, np.inf, 1.0, 1.0)}, "window: expected finite corners"),
]


@pytest.mark.parametrize(("changes", "message"), BAD)
def test_refuses(kernels: Kernels, changes: dict[str, Any], message: str) -> None:
    """Another number of observations, unlike shapes and numbers out of range are named."""
    with pytest.raises(ValueError, match=message):
        kernels.target_model(**case(**changes))


def test_native_takes_a_list_that_gets_shorter_meanwhile() -> None:
    """Python that runs while a list is read may empty it; what is left is too short."""
    lows: list[Any] = []

    class Number:
        def __float__(self) -> float:
            lows.clear()
            return 0.0

    densities, _, peaks = former(0, 3)
    lows += [Number(), 1.0, 2.0]
    with pytest.raises(ValueError, match="before: expected 3 lows and peaks"):
        _core.target_model(**case(before=(densities, lows, peaks)))
