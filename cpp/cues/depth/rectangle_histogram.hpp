// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Histogram of the depths in one rectangle relative to its own depth, counted as by depth_distance, whose model learns it.
///
/// @param depth float32 (H, W), meters; may be empty
/// @param rectangle float64 (5,): center x, y, width, height, pixels; depth z, meters; finite
/// @param levels of [-reach, reach), 1 to 65536
/// @param pattern float64 (n, 2), n at least 1: (u, v), 1 being the right and the lower edge; finite
/// @param reach meters, finite, above 0
/// @returns float64 (levels,) of sum 1; all 0 where nothing counts
/// @throws std::invalid_argument on other shapes or values
/// Source: Sabeti, Parvizi, Wu 2008, H of equation (38), section IV.B; depth relative to z is ours.
Vector rectangle_histogram(const DepthView& depth, VectorRef rectangle, int levels, StatesRef pattern,
                           double reach);

}  // namespace tricue
