// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "fuse/block_counts.hpp"
#include "fuse/detail/block_grid.hpp"
#include "fuse/detail/disparity_limits.hpp"
#include "fuse/target_pixels.hpp"
#include "fuse/temporal_window.hpp"

namespace tricue {

/// The range of a density's bins.
struct BinRange {
    double low, high;
};

/// The densities of K observations.
struct CueDensities {
    StatesRef densities;           ///< float64 (K, bins): P(value | target), of sum 1 or 0
    std::vector<BinRange> ranges;  ///< (low, high) of each one's bins, finite, low < high
    StatesRef alternatives;  ///< float64 (K, bins): P(value | not the target), above 0, of a sum of at most 1
};

/// Which target pixels are kept, as in temporal_window.
struct CleanUp {
    int neighbors;  ///< 0 to 8
    double share;   ///< in [0, 1]
    double trim;    ///< in [0, 0.5)
};

struct TargetObservation {
    TemporalWindow window;
    BlockCounts counts;
    double occluded;
};

/// The target in a frame, by its model: its pixels, and the contents of its blocks.
///
/// The target_pixels of the observations, cleaned as by temporal_window, and the block_counts of the kept pixels. A block is
/// occluded if the mean of its disparities is above the occluder's, and a fifth of its pixels or more have one. Blocks that
/// aren't in the image don't count.
///
/// The prior is that of target_pixels; the clean-up, that of temporal_window.
///
/// @param planes float32 (H, W), K of them, one to three: observations u, v or d, NaN where there is none
/// @param threshold smallest posterior of a target pixel, in (0, 1]
/// @param disparity float32 (H, W), pixels, NaN where there is none; None if not measured: then all pixels of a block count as
///     measured, and no block is occluded
/// @param states int64 (N,): 0 where a block isn't the target's
/// @returns box (x0, y0, x1, y1), pixels, of the temporal window
/// @returns count number of target pixels
/// @returns mask uint8 (H, W): 1 at the target's pixels, else 0
/// @returns counts (pixels, targets, measured, mean, similar), (N,) each: the contents of the blocks, as in block_counts
/// @returns occluded share of the target's blocks in the image that something nearer hides, in [0, 1]
/// @throws std::invalid_argument as these kernels, on different sizes, and on a place that is not finite
/// Source: Okada, Shirai, Miura 1996, sections 4.1 to 4.4.
TargetObservation observe_target(const std::vector<PlaneView>& planes, const CueDensities& model,
                                 const TargetPrior& prior, double threshold, const CleanUp& clean,
                                 const std::optional<PlaneView>& disparity, const BlockGrid& grid,
                                 BlockNumbers states, const DisparityLimits& limits);

}  // namespace tricue
