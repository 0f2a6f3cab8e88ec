// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Which gaps are filled, as in fill_gaps.
struct Gaps {
    double gap, slope, max_gap_share;
    int passes;
};

/// Fills the gaps of a depth image that is riddled with small ones, and would fall apart into pieces; leaves any other as it is.
///
/// Small gaps are one to three unmeasured pixels between two measured ones of a row. An image has many if they are more than the
/// share `max_gap_share` of the measured pixels. Then, until they are at most half that share, and at most `passes` times, each
/// unmeasured pixel with at least two neighbors (of 8) on the nearest surface becomes their mean. On it are the neighbors z' with
/// z' <= z + (gap + slope (z z)), z the nearest. Nearer surfaces win, because a sensor loses their outlines first; so a pass also
/// widens a surface that ends at a large gap by a pixel.
///
/// All in float32, in this order; sums over the neighbors are in reading order. A pass reads the result of the one before.
///
/// @param depth float32 (H, W), meters
/// @param gap meters, finite, at least 0
/// @param slope 1 / meter, finite, at least 0: noise of stereo and of structured light grows with z²
/// @param max_gap_share small gaps per measured pixel, in [0, 1]
/// @param passes 0 to 1000
/// @returns float32 (H, W), meters; NaN where nothing was measured or filled
/// @throws std::invalid_argument on parameters out of range
/// Source: ours.
Floats fill_gaps(const DepthView& depth, double gap, double slope, double max_gap_share, int passes);

/// Its parts. @throws std::invalid_argument as fill_gaps
void require_gaps(const Gaps& gaps);
bool has_many_gaps(const DepthView& depth, double share);
/// The passes, and the result.
Floats run_passes(const DepthView& depth, const Gaps& gaps);

}  // namespace tricue
