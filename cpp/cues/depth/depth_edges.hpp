// SPDX-License-Identifier: MIT
#pragma once

#include "base/depth_pixels.hpp"
#include "base/depth_view.hpp"
#include "base/simd.hpp"

namespace tricue {

/// Where depth jumps: 1 at the farther of two neighbors (8) whose depths differ by more than noise and a slanted surface explain.
///
/// So a nearer object keeps its outline, and is cut from the surface behind it. An edge is where z - z' > gap + slope (z' z') for
/// a measured neighbor z', in float32 in this order.
///
/// @param depth float32 (H, W), meters; a pixel that is not measured is no edge, and makes none
/// @param gap meters, finite, at least 0
/// @param slope 1 / meter, finite, at least 0: noise of stereo and of structured light grows with z²
/// @returns uint8 (H, W) of 0 and 1
/// @throws std::invalid_argument on an invalid gap or slope
/// Source: ours.
Labels depth_edges(const DepthView& depth, double gap, double slope);

/// @throws std::invalid_argument as depth_edges
void require_gap(double gap, double slope);

/// Whether one pixel is an edge, by the nearest of its neighbors: the threshold grows with a neighbor's depth, rounding included. The
/// pixel itself may be among them, as it never exceeds its own threshold.
TRICUE_INLINE bool is_edge(float z, float nearest, float gap, float slope) {
    return has_depth(z) & (z - nearest > gap + slope * (nearest * nearest));
}

}  // namespace tricue
