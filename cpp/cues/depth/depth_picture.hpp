// SPDX-License-Identifier: MIT
#pragma once

#include "base/depth_pixels.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// A gray picture of a depth image, in which a target at depth z looks the same at any distance.
///     128 + 127 (depth - z) / reach,  the depth clamped to z - reach and z + reach, rounded down, in float32
///
/// Black, 0 or 1, where it is nearer than z by reach or more; white, 254 or 255, where it is farther by as much, or not a number.
///
/// @param depth float32 (H, W), meters; may be empty
/// @param z depth that is gray, meters, finite
/// @param reach meters from gray to black or white, finite, above 0
/// @returns uint8 (H, W)
/// @throws std::invalid_argument on numbers out of range
/// Source: ours.
Labels depth_picture(const DepthView& depth, double z, double reach);

}  // namespace tricue
