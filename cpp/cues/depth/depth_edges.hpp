// SPDX-License-Identifier: MIT
#pragma once

#include "base/depth_pixels.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Where depth jumps: 1 at the farther pixel of each two neighbours (8) whose depths differ by more than a sensor's noise
/// and a slanted surface explain. So a nearer object keeps its outline, and is cut from what is behind it.
///
/// An edge is where z - z' > gap + slope (z' z') for a measured neighbour z', in float32 in this order.
///
/// @param depth metres; what wasn't measured is no edge, and makes none
/// @param gap   metres, finite, not negative
/// @param slope 1 / metre, finite, not negative: noise of stereo and of structured light grows with z^2
/// @returns     (H, W) of 0 and 1
/// @throws std::invalid_argument on a gap or slope that is none
/// Source: ours.
Labels depth_edges(const DepthView& depth, double gap, double slope);

}  // namespace tricue
