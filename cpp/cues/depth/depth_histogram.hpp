// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/image_view.hpp"

namespace tricue {

struct DepthLevels {
    double near, far;  ///< metres, finite, near < far: depths in [near, far) are counted
    int count;         ///< 1 to 65536
};

/// How many pixels under the mask lie in every level of depth.
///
/// level = floor((z - near) (levels / (far - near))), from 0 to levels - 1, in float32, to which near and the quotient are
/// rounded; what is in [near, far) is decided exactly.
///
/// @param depth metres; what wasn't measured isn't counted
/// @param mask  of the same shape: pixels where it is 0 aren't counted
/// @returns     (levels,) counts
/// @throws std::invalid_argument on a mask of another shape, or levels that are none
/// Source: Sabeti, Parvizi, Wu 2008, section IV.A: the histogram behind p(z), equation (32).
Vector depth_histogram(const DepthView& depth, const ImageView& mask, const DepthLevels& levels);

}  // namespace tricue
