// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "fuse/block_counts.hpp"
#include "fuse/detail/block_grid.hpp"
#include "fuse/target_pixels.hpp"
#include "fuse/temporal_window.hpp"

namespace tricue {

/// Which target pixels are kept, as in temporal_window.
struct CleanUp {
    int neighbors;
    double share, trim;
};

/// The disparities that are similar to the target's, and those of an occluder.
struct DisparityLimits {
    double target, tolerance, occluder;
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
/// @param planes float32 (H, W), one to three: observations u, v or d, NaN where there is none
/// @param densities float64 (K, bins), one for each: P(value | target), of sum 1 or 0
/// @param ranges (low, high) for each plane: range of its bins, finite, low < high
/// @param alternatives float64 (K, bins): P(value | not the target), above 0, of a sum of at most 1
/// @param window (x0, y0, x1, y1), where the prior of target_pixels is 1, pixels, finite
/// @param candidate (x0, y0, x1, y1), outside of which this prior is 0, pixels, finite
/// @param threshold smallest posterior of a target pixel, in (0, 1]
/// @param clean (neighbors, share, trim) as in temporal_window
/// @param disparity float32 (H, W), pixels, NaN where there is none; None if not measured: then all pixels of a block count as
///     measured, and no block is occluded
/// @param corners float64 (N, 4): x0, y0, x1, y1 of each block in its grid
/// @param place (size, x, y, left, top), finite: a corner c of the grid is at size c + (x, y) - (left, top), pixels
/// @param states int64 (N,): 0 where a block isn't the target's
/// @param limits (target, tolerance, occluder), disparities, pixels: similar ones differ by at most the tolerance from the
///     target's; those above the third are an occluder's
/// @returns box (x0, y0, x1, y1), pixels, of the temporal window
/// @returns count number of target pixels
/// @returns mask uint8 (H, W): 1 at the target's pixels, else 0
/// @returns counts (pixels, targets, measured, mean, similar), (N,) each: the contents of the blocks, as in block_counts
/// @returns occluded share of the target's blocks in the image that something nearer hides, in [0, 1]
/// @throws std::invalid_argument as these kernels, on different sizes, and on a place that is not finite
/// Source: Okada, Shirai, Miura 1996, sections 4.1 to 4.4.
TargetObservation observe_target(const std::vector<Cue>& cues, const TargetPlace& place, double threshold,
                                 const CleanUp& clean, const std::optional<PlaneView>& disparity,
                                 const BlockGrid& grid, BlockNumbers states, const DisparityLimits& limits);

}  // namespace tricue
