// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/plane_view.hpp"

namespace tricue {

/// Share of a block's pixels: with fewer disparities, their mean isn't reliable.
constexpr double kMinMeasuredShare = 0.2;

/// The contents of N blocks.
struct BlockCounts {
    Indices pixels;    ///< int64 (N,): pixels of each block that are in the image
    Indices targets;   ///< int64 (N,): those set in the mask
    Indices measured;  ///< int64 (N,): those with a finite disparity
    Vector mean;       ///< float64 (N,): mean of these disparities, pixels; NaN without any
    Indices similar;   ///< int64 (N,): those that differ by at most the tolerance from the expected one
};

/// The contents of the target window's blocks in a frame, by which their states change.
///
/// @param mask uint8 (H, W): target pixels, those that are not 0
/// @param disparity float32 (H, W), pixels, NaN where there is none
/// @param blocks float64 (N, 4): x0, y0, x1, y1, pixels, finite; a block has the pixels whose centers lie in it, the first pixel
///     being [0, 1) x [0, 1)
/// @param expected a disparity, pixels; NaN for none
/// @param tolerance a similar disparity differs by at most this from it, pixels
/// @throws std::invalid_argument on a mask of another shape, blocks of another shape, or corners that are not finite
/// Source: Okada, Shirai, Miura 1996, section 4.4 and figure 7.
BlockCounts block_counts(const ImageView& mask, const PlaneView& disparity, StatesRef blocks, float expected,
                         float tolerance);

}  // namespace tricue
