# SPDX-License-Identifier: MIT
"""The target's part of a histogram."""

from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d
from scipy.signal import argrelmin
from scipy.stats import norm
from tricue import _core, reference
from tricue.kernels import Kernels

Floats = NDArray[np.float64]
EPS = float(np.finfo(np.float64).eps)

# Few levels make plateaus and ties.
stairs = arrays(np.float64, st.integers(1, 40), elements=st.integers(0, 4).map(float))
slopes = arrays(np.float64, st.integers(1, 60), elements=st.floats(0, 1, width=32))
smoothings = st.sampled_from([0.0, 1e-300, 0.3, 1.0]) | st.floats(0, 1)  # of the bins
ripples = st.sampled_from([0.0, 0.05, 0.3]) | st.floats(0, 0.99)
# Off the range too, and so far off that all factors underflow.
places = st.integers(-40, 640).map(lambda eighths: eighths / 8)
expectations = (
    st.just(np.nan) | places | st.floats(-100, 200) | st.floats(allow_nan=False, allow_infinity=False)
)
spreads = st.floats(0.3, 20) | st.floats(0, exclude_min=True)


def bumps(count: int, *parts: tuple[float, float, float]) -> Floats:
    """(count,) the sum of normal densities: weight, mean, standard deviation; bin i is [i, i + 1)."""
    edges = np.arange(count + 1)
    shares = [weight * np.diff(norm.cdf(edges, mean, width)) for weight, mean, width in parts]
    return np.asarray(np.sum(shares, axis=0))


@given(stairs | slopes, smoothings, ripples)
def test_twin_cuts_the_same(histogram: Floats, share: float, min_prominence: float) -> None:
    """Native and reference agree on any histogram. Three values rounded to some 1e-15 of the peak, and a
    curvature above 2e-9 of it, place a peak to 1e-6, and so the line; most are placed far better.
    """
    smoothing = share * min(len(histogram), 12)
    ours, theirs = (k.target_distribution(histogram, smoothing, min_prominence) for k in (_core, reference))
    assert ours[0].shape == theirs[0].shape == histogram.shape
    assert_allclose(ours[1], theirs[1], rtol=0, atol=2e-6)
    assert_allclose(ours[0], theirs[0], rtol=0, atol=8e-6)


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("bins", [16, 64, 81, 256])
def test_twin_cuts_histograms_the_same(bins: int, seed: int) -> None:
    """On noisy histograms as they are, whose peaks are no plateaus, they agree to hundreds of roundings."""
    rng = np.random.default_rng(seed)
    parts = [(w, m * bins, bins / 20) for w, m in zip(rng.random(3), rng.random(3), strict=True)]
    histogram = rng.poisson(300 * bumps(bins, *parts)) + rng.random(bins)
    for smoothing in (0.7, 1.5, 4.0):
        ours, theirs = (k.target_distribution(histogram, smoothing) for k in (_core, reference))
        assert_allclose(ours[1], theirs[1], rtol=1e-11)
        assert_allclose(ours[0], theirs[0], rtol=1e-10, atol=1e-14)


def smoothed(histogram: Floats, smoothing: float) -> Floats:
    """SciPy's Gaussian of the histogram over that of ones."""
    radius = int(np.ceil(4 * smoothing))
    total, ones = (
        gaussian_filter1d(np.pad(values, radius), smoothing, radius=radius, mode="constant")
        for values in (histogram, np.ones(len(histogram)))
    )
    return np.asarray((total / ones)[radius : radius + len(histogram)])


def weighted(histogram: Floats, smoothing: float, expected: float, spread: float) -> Floats:
    """What the peak is of, as it is defined, by SciPy; it may underflow."""
    smooth = smoothed(histogram, smoothing) if smoothing > 0.1 else histogram
    return np.asarray(smooth * norm.pdf(np.arange(len(histogram)) + 0.5, expected, spread))


def rises(side: Floats) -> float:
    """How far values rise again at most, from the peak outwards."""
    return float((side - np.minimum.accumulate(side)).max())


@given(slopes, st.floats(0.2, 4))
def test_smoothing_agrees_with_scipy(histogram: Floats, smoothing: float) -> None:
    """Where nothing is cut the density is SciPy's Gaussian of the histogram over that of ones, of sum 1."""
    assume(histogram.max() > 0.1)
    smoothing = min(smoothing, len(histogram))
    smooth = smoothed(histogram, smoothing)
    at = smooth.argmax()
    assume(max(rises(smooth[at:]), rises(smooth[at::-1])) < 0.98 * smooth[at])
    for k in (_core, reference):
        density, _ = k.target_distribution(histogram, smoothing, 0.99)
        assert_allclose(density, smooth / smooth.sum(), rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("mean", [20.0, 20.25, 20.5, 20.75, 41.1])
def test_finds_a_known_velocity(kernels: Kernels, mean: float) -> None:
    """A normal density's mean is found to a fiftieth of a bin, wherever in a bin it lies, at an edge too."""
    _, peak = kernels.target_distribution(bumps(64, (1, mean, 2.0)), 1.0)
    assert abs(peak - mean) < 0.02


@given(stairs | slopes, smoothings, ripples, expectations, spreads)
def test_twin_expects_the_same(
    histogram: Floats, share: float, min_prominence: float, expected: float, spread: float
) -> None:
    """Native and reference agree on any expectation, however far off or narrow, as closely as without: the
    weighted values are one rounding of exp less certain.
    """
    smoothing = share * min(len(histogram), 12)
    arguments = histogram, smoothing, min_prominence, expected, spread
    ours, theirs = (k.target_distribution(*arguments) for k in (_core, reference))
    assert_allclose(ours[1], theirs[1], rtol=0, atol=2e-6)
    assert_allclose(ours[0], theirs[0], rtol=0, atol=8e-6)


@given(slopes, st.floats(0.2, 4), places, st.floats(0.7, 20))
def test_weighs_as_scipy_does(histogram: Floats, smoothing: float, expected: float, spread: float) -> None:
    """The peak lies in the highest bin of SciPy's Gaussian of the histogram times SciPy's normal density."""
    smoothing = min(smoothing, len(histogram))
    values = weighted(histogram, smoothing, expected, spread)
    order = np.argsort(values)
    assume(values[order[-1]] > 1e-250)  # nothing has underflowed that matters
    assume(len(values) == 1 or values[order[-2]] < values[order[-1]] * (1 - 1e-6))
    for k in (_core, reference):
        _, peak = k.target_distribution(histogram, smoothing, 0.05, expected, spread)
        assert int(peak) == order[-1]


@pytest.mark.parametrize(("expected", "spread"), [(30.0, 4.0), (24.4, 6.0), (33.7, 3.0)])
def test_product_of_two_gaussians(kernels: Kernels, expected: float, spread: float) -> None:
    """Of a normal histogram, mean 28.3, standard deviation 3, the peak is the mean of the product of two
    normal densities, each weighted by its precision, to a fiftieth of a bin.
    """
    _, peak = kernels.target_distribution(bumps(64, (1, 28.3, 3.0)), 0.0, 0.05, expected, spread)
    mean = (28.3 / 3**2 + expected / spread**2) / (1 / 3**2 + 1 / spread**2)
    assert abs(peak - mean) < 0.02


def test_keeps_to_the_expected_peak(kernels: Kernels) -> None:
    """Of a target and a background that fills more of the window, the one is found that is expected, to a
    tenth of its width, and nearly its own density; without an expectation the background's.
    """
    target, background = bumps(80, (1, 30.2, 3.0)), bumps(80, (1, 48.0, 3.0))
    mixed = 0.4 * target + 0.6 * background
    density, peak = kernels.target_distribution(mixed, 0.5, 0.05, 30.5, 12.0)
    assert abs(peak - 30.2) < 0.3
    assert abs(density - target).sum() < 0.1
    for expected in (np.nan, 47.0):
        density, peak = kernels.target_distribution(mixed, 0.5, 0.05, expected, 12.0)
        assert abs(peak - 48) < 0.3
        assert abs(density - background).sum() < 0.1


def test_shoulder_by_hand(kernels: Kernels) -> None:
    """Where the histogram rises at once nothing is left beyond the peak's bin; on the other side the line
    falls from the histogram's height there, 3, not from the highest.
    """
    histogram = np.array([0.0, 9, 2, 3, 5, 20, 1])
    density, peak = kernels.target_distribution(histogram, 0.0, 0.0, 3.5, 0.1)
    assert_allclose(peak, 3.5, atol=1e-12)
    assert_allclose(density, np.array([0, 1, 2, 3, 0, 0, 0]) / 6, rtol=1e-9, atol=1e-12)


def test_slight_rise_is_no_shoulder(kernels: Kernels) -> None:
    """What rises from the peak by at most the prominence, and falls again, stays."""
    histogram = np.array([0.0, 40, 100, 103, 50, 0])
    kept, _ = kernels.target_distribution(histogram, 0.0, 0.04, 2.5, 0.3)
    assert_allclose(kept, histogram / histogram.sum())
    cut, _ = kernels.target_distribution(histogram, 0.0, 0.02, 2.5, 0.3)
    assert_allclose(cut, np.array([0, 40, 100, 0, 0, 0]) / 140)


FAR = [(1e4, 4), (-1e4, 2), (1e308, 4), (-1.7e308, 2), (5.2, 4), (6.2, 7), (0.1, 2)]


@pytest.mark.parametrize(("expected", "nearest"), FAR)
@pytest.mark.parametrize("spread", [5e-324, 1e-200, 1e-3])
def test_nothing_near(kernels: Kernels, expected: float, nearest: int, spread: float) -> None:
    """Where all factors but one underflow, or all would, the peak is the nearest bin that isn't empty, the
    first or last for what is off the range.
    """
    histogram = np.array([0, 0, 3, 8, 2, 0, 0, 6, 0, 0.0])
    if abs(expected) > 10:
        histogram[7] = 0
    density, peak = kernels.target_distribution(histogram, 0.0, 0.0, expected, spread)
    assert peak == nearest + 0.5
    assert density[nearest] == 1


def test_no_expectation(kernels: Kernels) -> None:
    """NaN, the default, an infinite spread and a huge one all take the highest peak: the paper's form."""
    histogram = np.random.default_rng(0).random(64)
    paper, peak = kernels.target_distribution(histogram, 1.5)
    for expected, spread in ((np.nan, 1.0), (20.0, np.inf), (1e308, np.inf), (20.0, 1e300)):
        density, same = kernels.target_distribution(histogram, 1.5, 0.05, expected, spread)
        assert_array_equal(density, paper)
        assert same == peak


def test_parabola(kernels: Kernels) -> None:
    """Of three bins on a parabola the peak is its top."""
    for top in (3.1, 3.5, 3.8):
        places = np.arange(7) + 0.5
        _, peak = kernels.target_distribution(np.maximum(100 - (places - top) ** 2, 0), 0.0)
        assert_allclose(peak, top, atol=1e-12)


def test_recovers_the_target_from_a_mixture(kernels: Kernels) -> None:
    """Of a target, weight 0.6, and a background some way off what remains is nearly the target's own density,
    and the uncut histogram is ten times as wrong. What is left beyond the minimum is the line's.
    """
    target = bumps(80, (1, 30.2, 3.0))
    mixed = 0.6 * target + bumps(80, (0.4, 48.0, 3.0))
    density, peak = kernels.target_distribution(mixed, 0.5)
    wrong, uncut = abs(density - target).sum(), abs(mixed - target).sum()
    assert wrong < 0.06 < 0.6 < uncut
    assert abs(peak - 30.2) < 0.05


@given(slopes, st.floats(0.5, 4))
def test_minima_are_scipys(histogram: Floats, smoothing: float) -> None:
    """With every rise taken, the histogram stays up to SciPy's first minimum on either side, then falls."""
    assume(len(histogram) > 8 and histogram.max() > 0.1)
    smooth = smoothed(histogram, smoothing)
    assume(np.abs(np.diff(smooth)).min() > 1e-8 * smooth.max())  # plateaus are no minima to SciPy
    (minima,) = argrelmin(smooth)
    at = int(smooth.argmax())
    first = max((m for m in minima if m < at), default=0)
    last = min((m for m in minima if m > at), default=len(histogram) - 1)
    inside = slice(first, last + 1)
    for k in (_core, reference):
        density, _ = k.target_distribution(histogram, smoothing, 0.0)
        assert_allclose(density[inside] / density[at], smooth[inside] / smooth[at], rtol=1e-9)
        for beyond in (density[: first + 1][::-1], density[last:]):
            assert (np.diff(beyond) <= 0).all()


def test_figure_6_by_hand(kernels: Kernels) -> None:
    """Beyond a minimum of 6, two bins from a peak of 10, the line falls by 2 a bin; a side without a minimum
    stays as it is.
    """
    histogram = np.array([0.0, 4, 10, 8, 6, 8, 9, 3, 5])
    density, peak = kernels.target_distribution(histogram, 0.0, 0.0)
    # The top of the parabola through 4, 10, 8 lies a quarter of a bin to the right.
    slope = (6 - 10) / (4 - 2.25)
    line = [10 + slope * (i - 2.25) for i in (5, 6)]
    expected = np.array([0, 4, 10, 8, 6, *line, 0, 0])
    assert line[1] > 0 > line[1] + slope
    assert peak == 2.75
    assert_allclose(density, expected / expected.sum(), rtol=1e-14)


def test_plateaus(kernels: Kernels) -> None:
    """A run of equal values is a minimum, at its end next to the peak, where it rises beyond; else none."""
    rises = np.array([9.0, 5, 5, 5, 6, 0])
    density, _ = kernels.target_distribution(rises, 0.0, 0.05)
    assert_allclose(density, np.array([9, 5, 1, 0, 0, 0]) / 15)
    falls = np.array([9.0, 5, 5, 5, 4, 4])
    density, _ = kernels.target_distribution(falls, 0.0, 0.05)
    assert_allclose(density, falls / falls.sum())


def test_gap_ends_the_target(kernels: Kernels) -> None:
    """Beyond bins of zeros nothing is left of what is there."""
    density, _ = kernels.target_distribution(np.array([0, 0, 3, 8, 2, 0, 0, 0, 7, 0.0]), 0.0)
    assert_allclose(density, np.array([0, 0, 3, 8, 2, 0, 0, 0, 0, 0]) / 13)


def test_min_prominence(kernels: Kernels) -> None:
    """A rise of at most the prominence ends no minimum, and the least before a larger one is the minimum."""
    histogram = np.array([100.0, 50, 30, 33, 20, 24, 90])
    (uneven, _), (even, _) = (
        kernels.target_distribution(histogram, 0.0, min_prominence) for min_prominence in (0.0, 0.04)
    )
    assert_allclose(uneven / uneven[0], [1, 0.5, 0.3, 0, 0, 0, 0])
    assert_allclose(even / even[0], [1, 0.5, 0.3, 0.33, 0.2, 0, 0])
    just, _ = kernels.target_distribution(histogram, 0.0, 0.039)
    assert_allclose(just, even)  # at 20 it rises by 4, then by 70


@pytest.mark.parametrize("bins", [1, 2, 5, 64])
def test_nothing_there(kernels: Kernels, bins: int) -> None:
    """Of a histogram of zeros the density is zeros, and there is no peak."""
    for expected in (np.nan, 0.7, -1e308):
        density, peak = kernels.target_distribution(np.zeros(bins), min(bins, 1.5), 0.05, expected)
        assert_array_equal(density, np.zeros(bins))
        assert np.isnan(peak)


@pytest.mark.parametrize("smoothing", [0.0, 0.7, 5.0])
def test_flat(kernels: Kernels, smoothing: float) -> None:
    """Equal bins stay equal, ends included, and their peak is the middle."""
    density, peak = kernels.target_distribution(np.full(10, 0.3), smoothing, 0.0)
    assert_allclose(density, np.full(10, 0.1), rtol=1e-14)
    assert peak == 5.0


@given(stairs | slopes, smoothings, ripples)
def test_is_a_density(histogram: Floats, share: float, min_prominence: float) -> None:
    """It has a sum of 1 and nothing below 0, and its peak lies in a bin that is as high as any."""
    assume(histogram.any())
    smoothing = share * min(len(histogram), 12)
    for k in (_core, reference):
        density, peak = k.target_distribution(histogram, smoothing, min_prominence)
        assert density.min() >= 0
        assert_allclose(density.sum(), 1, rtol=1e-12)
        assert 0.5 <= peak <= len(histogram) - 0.5
        beside = density[[int(np.floor(peak - 0.5)), int(np.ceil(peak - 0.5))]]
        assert beside.max() >= density.max() * (1 - 1e-8)


@given(stairs | slopes, smoothings, ripples, expectations, spreads)
def test_is_a_density_where_expected(
    histogram: Floats, share: float, min_prominence: float, expected: float, spread: float
) -> None:
    """So it is with any expectation, its peak lies in a bin that isn't empty, and outwards from there no bin
    is higher than the least before by more than the prominence.
    """
    assume(histogram.any())
    smoothing = share * min(len(histogram), 12)
    for k in (_core, reference):
        density, peak = k.target_distribution(histogram, smoothing, min_prominence, expected, spread)
        assert density.min() >= 0
        assert_allclose(density.sum(), 1, rtol=1e-12)
        assert 0.5 <= peak <= len(histogram) - 0.5
        at = int(peak)
        assert density[at] > 0
        assert max(rises(density[at:]), rises(density[at::-1])) <= (min_prominence + 1e-8) * density[at]


@given(slopes, smoothings, ripples, places, st.floats(0.7, 20))
def test_mirror_of_the_expected(
    histogram: Floats, share: float, min_prominence: float, expected: float, spread: float
) -> None:
    """Leftward velocities are expected as rightward ones are."""
    smoothing = share * min(len(histogram), 12)
    values = weighted(histogram, smoothing, expected, spread)
    assume(values.max() > 1e-250)
    assume(np.count_nonzero(values >= values.max() * (1 - 1e-6)) == 1)  # of equal peaks the first is taken
    count = len(histogram)
    here = _core.target_distribution(histogram, smoothing, min_prominence, expected, spread)
    turned = np.ascontiguousarray(histogram[::-1])
    there = _core.target_distribution(turned, smoothing, min_prominence, count - expected, spread)
    assert_allclose(there[1], count - here[1], atol=1e-6)
    assert_allclose(there[0][::-1], here[0], rtol=0, atol=4e-6)


@given(slopes, smoothings, ripples)
def test_mirror(histogram: Floats, share: float, min_prominence: float) -> None:
    """Leftward velocities are estimated as rightward ones are."""
    smoothing = share * min(len(histogram), 12)
    here = _core.target_distribution(histogram, smoothing, min_prominence)
    there = _core.target_distribution(np.ascontiguousarray(histogram[::-1]), smoothing, min_prominence)
    smooth = smoothed(histogram, smoothing) if smoothing > 0.1 else histogram
    assume(np.count_nonzero(smooth >= smooth.max() * (1 - 1e-6)) == 1)  # of equal peaks the first is taken
    assert_allclose(there[1], len(histogram) - here[1], atol=1e-6)
    assert_allclose(there[0][::-1], here[0], rtol=0, atol=1e-6)


@given(slopes, smoothings, ripples, st.integers(-30, 30))
def test_units_of_the_weights(histogram: Floats, share: float, min_prominence: float, power: int) -> None:
    """How much all weights are together makes no difference."""
    smoothing = share * len(histogram)
    here = _core.target_distribution(histogram, smoothing, min_prominence)
    there = _core.target_distribution(2.0**power * histogram, smoothing, min_prominence)
    assert_array_equal(here[0], there[0])
    assert_array_equal(here[1], there[1])


@pytest.mark.parametrize("most", [5e-324, 1e-310, 1.7e308])
def test_least_and_greatest_weights(kernels: Kernels, most: float) -> None:
    """Weights whose sum is no float, or hardly one, are as good as any."""
    density, peak = kernels.target_distribution(np.array([0, most, most, 0]), 0.0)
    assert_array_equal(density, [0, 0.5, 0.5, 0])
    assert peak == 2.0


BAD_VALUES: list[tuple[Floats, float, float, str]] = [
    (np.empty(0), 0.0, 0.0, "histogram: expected at least one bin, got none"),
    (np.array([1.0, -1]), 0.0, 0.0, "histogram: expected finite numbers, none negative, got -1"),
    (np.array([1.0, np.nan]), 0.0, 0.0, "histogram: expected finite numbers, none negative, got nan"),
    (np.array([1.0, np.inf]), 0.0, 0.0, "histogram: expected finite numbers, none negative, got inf"),
    (np.ones(4), -0.1, 0.0, r"smoothing: expected a number in \[0, 4\], got -0.1"),
    (np.ones(4), 4.5, 0.0, r"smoothing: expected a number in \[0, 4\], got 4.5"),
    (np.ones(4), np.nan, 0.0, r"smoothing: expected a number in \[0, 4\], got nan"),
    (np.ones(4), 0.0, -0.1, r"min_prominence: expected a number in \[0, 1\), got -0.1"),
    (np.ones(4), 0.0, 1.0, r"min_prominence: expected a number in \[0, 1\), got 1"),
    (np.ones(4), 0.0, np.nan, r"min_prominence: expected a number in \[0, 1\), got nan"),
]


@pytest.mark.parametrize(("histogram", "smoothing", "min_prominence", "message"), BAD_VALUES)
def test_refuses(
    kernels: Kernels, histogram: Floats, smoothing: float, min_prominence: float, message: str
) -> None:
    """What is no histogram, and a smoothing or prominence that is none, is named."""
    with pytest.raises(ValueError, match=message):
        kernels.target_distribution(histogram, smoothing, min_prominence)


BAD_EXPECTATIONS: list[tuple[float, float, str]] = [
    (np.inf, 1.0, "expected: expected a finite number or NaN, got inf"),
    (-np.inf, 1.0, "expected: expected a finite number or NaN, got -inf"),
    (2.0, 0.0, "spread: expected a number above 0, got 0"),
    (np.nan, -1.0, "spread: expected a number above 0, got -1"),
    (2.0, np.nan, "spread: expected a number above 0, got nan"),
]


@pytest.mark.parametrize(("expected", "spread", "message"), BAD_EXPECTATIONS)
def test_refuses_expectations(kernels: Kernels, expected: float, spread: float, message: str) -> None:
    """An infinite peak, and what is no spread, is named, of zeros too."""
    for histogram in (np.ones(4), np.zeros(4)):
        with pytest.raises(ValueError, match=message):
            kernels.target_distribution(histogram, 0.0, 0.05, expected, spread)


BAD: list[tuple[Any, type[Exception], str]] = [
    (np.ones(7, np.float32), TypeError, r"histogram: expected float64 \(N,\), got float32"),
    (np.ones((7, 1)), ValueError, r"histogram: expected float64 \(N,\), got float64 \(7, 1\)"),
    (np.ones(7)[::2], ValueError, "histogram: expected a C-contiguous"),
]


@pytest.mark.parametrize(("histogram", "error", "message"), BAD)
def test_native_refuses(histogram: Any, error: type[Exception], message: str) -> None:
    """Another type, shape or layout is named, not converted."""
    with pytest.raises(error, match=message):
        _core.target_distribution(histogram, 0.0)
