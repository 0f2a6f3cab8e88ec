// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/region.hpp"

namespace tricue {

/// The last depth seen in each pixel beside a target: the depth image, but the remembered depth where it shows the target.
///
/// The target's pixels are those in its region with |depth - z| < reach, in float32, to which z and reach are rounded.
///
/// @param depth float32 (H, W), meters
/// @param before float32 (H, W), meters: the depth remembered so far; (0, 0) for none, which gives NaN
/// @param region (x0, y0, x1, y1), pixels: the target is in [x0, x1) x [y0, y1), which may extend beyond the image
/// @param z the target's depth, meters, finite
/// @param reach depths less than this from z are the target's, meters, finite, at least 0
/// @returns float32 (H, W), meters
/// @throws std::invalid_argument on images of different shapes, or an invalid z or reach
/// Source: ours.
Floats remember_depth(const DepthView& depth, const DepthView& before, const Region& region, double z,
                      double reach);

}  // namespace tricue
