// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Fills the gaps of a depth image that is riddled with them, which would fall apart into pieces; leaves any other as it is.
///
/// An image is ragged where rows have many small gaps, of one to three unmeasured pixels between two measured ones: more of
/// them than the share `ragged` of the measured pixels. Large gaps don't count: the shadows of structured light, and what is
/// out of range. If it is, then until it is at most half as ragged, and at most `passes` times, all unmeasured pixels with at
/// least two neighbours (of 8) on the nearest surface become the mean of these. On it are the neighbours z' with
/// z' <= z + gap + slope (z z), z the nearest. Nearer things win, because a sensor loses their outlines first. So a pass also
/// widens what ends at a large gap by a pixel.
///
/// All in float32, in this order; sums over the neighbours in reading order, a pass reads the result of the one before.
///
/// @param depth  metres
/// @param gap    metres, finite, not negative
/// @param slope  1 / metre, finite, not negative: noise of stereo and of structured light grows with z^2
/// @param ragged small gaps per measured pixel, 0 to 1
/// @param passes at least 0
/// @returns      (H, W) metres, NaN where nothing was measured and nothing filled
/// @throws std::invalid_argument on parameters out of these ranges
/// Source: ours.
Floats fill_gaps(const DepthView& depth, double gap, double slope, double ragged, int passes);

}  // namespace tricue
