// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

/// Count, mean and covariance of the skin pixels in a region: the Gaussian of the proposal. Of many rows, every step-th tells about the
/// same.
///
/// Pixels are classified by (5)-(10). As printed, (14)-(16) are sums of squares; here they are divided by the count, as (11)-(12)
/// are. A pixel stands for its center, (column + 0.5, row + 0.5).
///
/// @param image uint8 (H, W, 3) BGR
/// @param reference uint8 (3,): the reference color c0, B, G, R
/// @param threshold a pixel is skin where Δ > threshold (skin_boundary), in [-1, 1]
/// @param region (x0, y0, x1, y1): the pixels [x0, x1) x [y0, y1), clipped to the image
/// @param step rows from one that is read to the next, at least 1; the first is number step // 2 of the clipped region
/// @returns float64 (6,): count, times the step; mean x, y, pixels; variance xx, yy and covariance xy, pixels²; all 0 without skin
/// @throws std::invalid_argument on a threshold outside [-1, 1], or a step below 1
/// Source: Sabeti, Parvizi, Wu 2008, equations (5)-(16).
Vector skin_moments(const ImageView& image, const Bgr& reference, double threshold, const Region& region,
                    int step);

}  // namespace tricue
