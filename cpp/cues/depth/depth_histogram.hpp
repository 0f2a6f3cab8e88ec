// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/image_view.hpp"

namespace tricue {

struct DepthLevels {
    double near, far;  ///< depths in [near, far) are counted, meters, finite, near < far
    int count;
};

/// Counts the pixels under a mask at each level of depth.
///
/// The level is floor((z - near) (levels / (far - near))), at most levels - 1, in float32, to which near and the quotient are
/// rounded; whether z is in [near, far) is decided exactly.
///
/// @param depth float32 (H, W), meters; pixels that are not measured are not counted
/// @param mask uint8 (H, W): pixels where it is 0 are not counted
/// @param levels 1 to 65536
/// @returns float64 (levels,)
/// @throws std::invalid_argument on a mask of another shape, or invalid levels
/// Source: Sabeti, Parvizi, Wu 2008, section IV.A: the histogram behind p(z), equation (32).
Vector depth_histogram(const DepthView& depth, const ImageView& mask, const DepthLevels& levels);

/// @throws std::invalid_argument as depth_histogram
void require_levels(const DepthLevels& levels);

}  // namespace tricue
