// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "base/arrays.hpp"
#include "base/rectangle.hpp"
#include "fuse/detail/block_grid.hpp"
#include "fuse/detail/target_histograms.hpp"

namespace tricue {

/// The expected peak of a histogram.
struct ExpectedPeak {
    double value, deviation, half_range;
};

/// The blocks whose pixels are the target's: those in its state that are trusted.
struct TargetBlocks {
    BlockGrid grid;
    BlockNumbers states, trusted;
};

/// Pixels that are farther from a disparity don't count in histograms of flow.
struct DepthLimit {
    double disparity, tolerance;
};

/// The model of the frame before.
struct FormerModel {
    StatesRef densities;
    std::vector<double> lows, peaks;
};

struct HistogramRules {
    int bins;
    double smoothing, min_prominence, density_memory, surround_weight;
};

struct TargetModel {
    States densities;     ///< float64 (K, bins), of sum 1 or 0: P(value | target)
    States alternatives;  ///< float64 (K, bins), above 0: P(value | not the target)
    Vector peaks;         ///< float64 (K,): representative velocity and disparity
};

/// The densities of each observation u, v, d for the target and for its surround, and the target's velocity and disparity: its
/// model in a frame before its pixels are known.
///
/// For each observation there is a weighted_histogram of the pixels of the target's blocks in the window, with `bins` that span
/// value ± half_range. Its target_distribution, with min_prominence and the peak expected in the middle, is the density, and its
/// peak the representative value; without values that is the expected one. Histograms of flow, those of all but the last
/// observation, only count pixels that have no disparity or one near the target's.
///
/// The density is mixed with the one before, moved to the new peak: m before + (1 - m) density, m the density_memory, divided by
/// the sum. The one before is linear between bins, and 0 beyond them.
///
/// The alternative is w S + (1 - w) / bins, with w the surround_weight and S the histogram of all pixels that aren't in the
/// target's blocks over the sum of their weights (of values in [-1e6, 1e6)), smoothed by a Gaussian of sum 1, cut off at ceil(3
/// smoothing) bins; without such pixels it is 1 / bins.
///
/// @param maps (values, weights) of each observation, one to three, as in weighted_histogram: float32 (H, W) each
/// @param expected (value, deviation, half_range) of each: its peak, the standard deviation from there, and half of the
///     histogram's range; finite, the latter two above 0, the deviation infinite for no expectation
/// @param window (x0, y0, x1, y1), pixels, finite: where the target's histograms are taken
/// @param blocks (grid, states, trusted), the first two as in observe_target; the target's are those of state 1 that are trusted for a
///     frame or more. None for all pixels
/// @param depth (disparity, tolerance), pixels: flow counts only near this disparity; None for any
/// @param before (densities, lows, peaks) of the frame before, with the lowest value of each histogram; None for none
/// @param rules (bins, smoothing, min_prominence, density_memory, surround_weight): 2 to 65536 bins, smoothing, above 0, and
///     min_prominence as in target_distribution, the others in [0, 1)
/// @throws std::invalid_argument on another number of observations, different shapes, or numbers out of range
/// Source: Okada, Shirai, Miura 1996, section 4.2; blocks, memory and the surround are ours.
TargetModel target_model(const std::vector<CueMap>& maps, const std::vector<ExpectedPeak>& expected,
                         const Rectangle& window, const std::optional<TargetBlocks>& blocks,
                         const std::optional<DepthLimit>& depth, const std::optional<FormerModel>& before,
                         const HistogramRules& rules);

}  // namespace tricue
