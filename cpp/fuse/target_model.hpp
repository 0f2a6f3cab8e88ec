// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "base/arrays.hpp"
#include "base/plane_view.hpp"
#include "base/rectangle.hpp"
#include "fuse/detail/block_grid.hpp"

namespace tricue {

/// One observation of each pixel: u, v or d, and its reliability.
struct CueMap {
    PlaneView readings, weights;
};

/// Where the peak of a histogram is expected.
struct ExpectedPeak {
    double value, deviation, half_range;
};

/// The blocks whose pixels are the target's, those that are its own and are trusted.
struct TargetBlocks {
    BlockGrid grid;
    BlockNumbers states, trusted;
};

/// Pixels that are farther from a disparity don't count in histograms of flow.
struct DepthLimit {
    double disparity, tolerance;
};

/// A model of the frame before.
struct FormerModel {
    StatesRef densities;
    std::vector<double> lows, peaks;
};

struct HistogramRules {
    int bins;
    double smoothing, ripple, memory, surround;
};

struct TargetModel {
    States densities;     ///< float64 (K, bins), of sum 1 or 0: P(reading | target)
    States alternatives;  ///< float64 (K, bins), above 0: P(reading | not the target)
    Vector peaks;         ///< float64 (K,): representative velocity and disparity
};

/// The target's densities of each observation u, v, d, those of what is around it, and its velocity and disparity: what is known of
/// the target in a frame before its pixels are.
///
/// Of each observation there is a weighted_histogram of `bins` from value - half_range to value + half_range of the pixels of the
/// target's blocks in the window. Its target_distribution, with a ripple and the peak expected in the middle, is the density, and its
/// peak the representative value; without readings the expected one. In histograms of flow, all but the last observation, count only
/// pixels that have no disparity or one near the target's.
///
/// The density is mixed with the one before, moved to the new peak: memory before + (1 - memory) density, divided by the sum. Between
/// bins it is linear, 0 beyond them.
///
/// The alternative is surround S + (1 - surround) / bins, with S the histogram of all pixels that aren't in the target's blocks over
/// the sum of their weights (of readings in [-1e6, 1e6)), smoothed by a Gaussian of sum 1, cut off at ceil(3 smoothing) bins; without
/// such pixels it is 1 / bins.
///
/// @param maps (values, weights) of each observation, one to three, as of weighted_histogram: float32 (H, W) each
/// @param expected (value, deviation, half_range) of each: its peak, the standard deviation from there, and half of the
///     histogram's range; finite, the latter two above 0, the deviation infinite for no expectation
/// @param window (x0, y0, x1, y1), pixels, finite: where the target's histograms are taken
/// @param blocks (corners, place, states, trusted) as of observe_target; the target's are those of state 1 that are trusted for a frame
///     or more. None for all pixels
/// @param depth (disparity, tolerance), pixels, that flow needs; None for any
/// @param before (densities, lows, peaks) of the frame before, with the lowest value of each histogram; None for none
/// @param rules (bins, smoothing, ripple, memory, surround): 2 to 65536 bins, smoothing, above 0, and ripple as of
///     target_distribution, the others in [0, 1)
/// @throws std::invalid_argument on another number of observations, unlike shapes, or numbers out of range
/// Source: Okada, Shirai, Miura 1996, section 4.2; blocks, memory and the surround are ours.
TargetModel target_model(const std::vector<CueMap>& maps, const std::vector<ExpectedPeak>& expected,
                         const Rectangle& window, const std::optional<TargetBlocks>& blocks,
                         const std::optional<DepthLimit>& depth, const std::optional<FormerModel>& before,
                         const HistogramRules& rules);

}  // namespace tricue
