// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// The histogram of the depths in one rectangle relative to its own depth, as depth_distance counts them: what a model learns.
///
/// @param depth     metres; may be empty
/// @param rectangle (5,): centre x, y, width, height, pixels; depth z, metres; finite
/// @param levels    of [-reach, reach), 1 to 65536
/// @param pattern   (n, 2): (u, v), 1 being the right and the lower edge; finite, n at least 1
/// @param reach     metres, finite, above 0
/// @returns         (levels,) of sum 1; all 0 where nothing counts
/// @throws std::invalid_argument on other shapes or values
/// Source: Sabeti, Parvizi, Wu 2008, H of equation (38), section IV.B; depth relative to z is ours.
Vector rectangle_histogram(const DepthView& depth, VectorRef rectangle, int levels, StatesRef pattern,
                           double reach);

}  // namespace tricue
