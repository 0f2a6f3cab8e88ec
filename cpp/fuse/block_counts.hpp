// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/plane_view.hpp"

namespace tricue {

/// Of N blocks each.
struct BlockCounts {
    Indices pixels;    ///< in the image
    Indices targets;   ///< set in the mask
    Indices readings;  ///< with a finite disparity
    Vector mean;       ///< disparity of those, pixels; NaN without any
};

/// What is seen in the blocks of the target window, by which their states change.
///
/// @param mask      (H, W) target pixels, those that aren't 0
/// @param disparity (H, W) pixels, NaN where there is no reading
/// @param blocks    (N, 4) x0, y0, x1, y1: of a block are the pixels whose centres lie in it (camera/rectangle.hpp)
/// @returns         means of sums in float64
/// @throws std::invalid_argument on a mask of another shape, and blocks of another shape or that aren't finite
/// Source: Okada, Shirai, Miura 1996, section 4.4 and figure 7.
BlockCounts block_counts(const ImageView& mask, const PlaneView& disparity, StatesRef blocks);

}  // namespace tricue
