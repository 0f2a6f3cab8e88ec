// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/plane_view.hpp"
#include "base/rectangle.hpp"
#include "fuse/detail/value_bins.hpp"

namespace tricue {

/// Histogram of a flow or a disparity in a region, weighted by its reliability: the sum of the weights in each bin.
///
/// Bin floor((value - low) (bins / (high - low))), at most bins - 1, in float32, to which low and the quotient are rounded; whether
/// a value is in [low, high) is decided exactly.
///
/// @param values float32 (H, W), pixels per frame or pixels; NaN, and values outside [low, high), are not counted
/// @param weights float32 (H, W): reliability, equation (5) or (9); one that is not finite and above 0 does not count
/// @param region (x0, y0, x1, y1), pixels: pixels whose centers lie in it count
/// @param low, high range of the bins, pixels, finite, low < high
/// @param bins 1 to 65536
/// @param mask uint8 (H, W): pixels where it is 0 do not count; None for all
/// @returns float64 (bins,)
/// @throws std::invalid_argument on weights or a mask of another shape, corners that are not finite, or an invalid range
/// Source: Okada, Shirai, Miura 1996, section 4.2; the mask is ours.
Vector weighted_histogram(const PlaneView& values, const PlaneView& weights, const Rectangle& region,
                          const ValueRange& range, const ImageView& mask);

}  // namespace tricue
