// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "base/depth_pixels.hpp"
#include "base/depth_view.hpp"
#include "base/simd.hpp"

namespace tricue {

/// Where a depth image differs from an earlier one by more than noise: 0 where |z - z'| <= noise + (slope z) z, otherwise 1, also
/// where either isn't measured.
///
/// Computed in float32, to which noise and slope are rounded, in this order.
///
/// @param depth float32 (H, W): z, meters, NaN where nothing was measured
/// @param before float32 (H, W): z', likewise
/// @param noise meters, finite, at least 0
/// @param slope 1 / meter, finite, at least 0: noise grows with z²
/// @returns uint8 (H, W) of 0 and 1
/// @throws std::invalid_argument on images of different shapes, or an invalid noise or slope
/// Source: ours.
Labels changed_depth(const DepthView& depth, const DepthView& before, double noise, double slope);

/// @throws std::invalid_argument as changed_depth
void require_noise(double noise, double slope);

/// Whether one pixel differs; no comparison with NaN holds.
TRICUE_INLINE bool has_changed(float z, float before, float noise, float slope) {
    return !(std::abs(z - before) <= noise + slope * z * z);
}

}  // namespace tricue
