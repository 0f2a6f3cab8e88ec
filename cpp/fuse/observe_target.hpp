// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "fuse/block_counts.hpp"
#include "fuse/detail/block_grid.hpp"
#include "fuse/target_pixels.hpp"
#include "fuse/temporal_window.hpp"

namespace tricue {

/// Which target pixels are kept, as of temporal_window.
struct CleanUp {
    int neighbors;
    double share, trim;
};

/// What is similar to the target's disparity, and from where something hides it.
struct DisparityLimits {
    double target, tolerance, occluder;
};

struct TargetObservation {
    TemporalWindow window;
    BlockCounts counts;
    double occluded;
};

/// What a frame shows of the target, by its model: its pixels, and what is in its blocks.
///
/// The target_pixels of the observations, cleaned as by temporal_window, and the block_counts of what is kept. A block is occluded if
/// the mean of its disparities is above the occluder's, and a fifth of its pixels or more have one. Blocks that aren't in the image
/// don't count.
///
/// @param planes float32 (H, W), one to three: observations u, v or d, NaN where there is none
/// @param densities float64 (K, bins), one for each: P(reading | target), of sum 1 or 0
/// @param ranges (low, high) for each plane: what its bins span, finite, low < high
/// @param alternatives float64 (K, bins): P(reading | not the target), above 0, of a sum of at most 1
/// @param window (x0, y0, x1, y1), where the target surely may be, pixels, finite
/// @param candidate (x0, y0, x1, y1), where the target may be at all, pixels, finite
/// @param threshold smallest posterior of a target pixel, in (0, 1]
/// @param clean (neighbors, share, trim) as of temporal_window
/// @param disparity float32 (H, W), pixels, NaN where there is none; None without: then all pixels of a block count as measured, and no
///     block is occluded
/// @param corners float64 (N, 4): x0, y0, x1, y1 of each block in its grid
/// @param place (size, x, y, left, top), finite: a corner is in the pixel size corner + (x, y) - (left, top)
/// @param states int64 (N,): 0 where a block isn't the target's
/// @param limits (target, tolerance, occluder), disparities, pixels: similar ones differ by less than the tolerance from the
///     target's; above the third something hides it
/// @returns box (x0, y0, x1, y1), pixels, of the temporal window
/// @returns count number of target pixels
/// @returns mask uint8 (H, W): 1 at the target's pixels, else 0
/// @returns counts (pixels, targets, readings, mean, similar), (N,) each: what is in the blocks, as of block_counts
/// @returns occluded share of the target's blocks in the image that something nearer hides, in [0, 1]
/// @throws std::invalid_argument as these kernels, on unlike sizes and on a place that is not finite
/// Source: Okada, Shirai, Miura 1996, sections 4.1 to 4.4.
TargetObservation observe_target(const std::vector<Cue>& cues, const TargetPlace& place, double threshold,
                                 const CleanUp& clean, const std::optional<PlaneView>& disparity,
                                 const BlockGrid& grid, BlockNumbers states, const DisparityLimits& limits);

}  // namespace tricue
