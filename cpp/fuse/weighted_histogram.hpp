// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/plane_view.hpp"
#include "base/rectangle.hpp"
#include "fuse/detail/value_bins.hpp"

namespace tricue {

/// The histogram of a flow or a disparity in a region, weighted by its reliability: the sum of the weights in every bin (value_bins.hpp).
///
/// @param values  (H, W) pixels a frame, or pixels; NaN, and what isn't in [low, high), isn't counted
/// @param weights (H, W) reliability, equation (5) or (9); one that isn't above 0 and finite doesn't count
/// @param region  pixels whose centres lie in it count
/// @param mask    (H, W), pixels where it is 0 don't count; all count where its data is null
/// @returns       (bins,), summed in float64
/// @throws std::invalid_argument on weights or a mask of another shape, corners that aren't finite, a range that is none
/// Source: Okada, Shirai, Miura 1996, section 4.2; the mask is ours: it keeps out what is nearer than the target.
Vector weighted_histogram(const PlaneView& values, const PlaneView& weights, const Rectangle& region,
                          const ValueRange& range, const ImageView& mask);

}  // namespace tricue
