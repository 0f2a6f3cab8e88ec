// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// The histogram of a target's depths relative to its own depth.
struct ReferenceHistogram {
    /// float64 (L,): of depths relative to the rectangle's; of sum 1, or all 0, none negative
    VectorRef histogram;
    double reach;  ///< the L levels cover [-reach, reach), meters, finite, above 0
};

/// Distance of the depths in each rectangle from a model, and the shares of the rectangle at its depth and in front of it.
///
/// Every rectangle is read at the same n places: pixel (floor(y + height / 2 v), floor(x + width / 2 u)) for each (u, v) of the
/// pattern, in float64; pixel (0, 0) covers [0, 1) x [0, 1). A depth counts where its level floor((depth - (z - reach)) (L / (2
/// reach))) is in [0, L), in float32, to which z - reach and L / (2 reach) are rounded; a place outside the image or without a
/// measurement does not. The histogram h of the depths that count, divided by their number, has the distance sqrt(Σ (h - m)²) / sqrt 2
/// from the model m: equation (38) over its maximum.
///
/// @param depth float32 (H, W), meters; may be empty
/// @param rectangles float64 (N, 5): center x, y, width, height, pixels; depth z, meters; finite
/// @param pattern float64 (n, 2), n at least 1: (u, v), 1 being the right and the lower edge; finite
/// @param occluder_margin meters, finite, at least 0
/// @returns float64 (N, 3): the distance, in [0, 1], 1 where nothing counts; the share of the places that count; the share of the
///     places whose depth is below z - occluder_margin
/// @throws std::invalid_argument on other shapes or values
/// Source: Sabeti, Parvizi, Wu 2008, equation (38), section IV.B; depth relative to z and the share in front are ours.
States depth_distance(const DepthView& depth, StatesRef rectangles, const ReferenceHistogram& model,
                      StatesRef pattern, double occluder_margin);

}  // namespace tricue
