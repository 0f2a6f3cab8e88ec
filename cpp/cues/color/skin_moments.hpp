// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

/// Count, mean and covariance of the skin pixels in a region: the Gaussian of the proposal.
///
/// Pixels are classified by (5)-(10) and summed in the same pass. As printed, (14)-(16) are sums of squares,
/// which are no covariance; here they are divided by the count as (11)-(12) are. A pixel stands for its
/// centre, (column + 0.5, row + 0.5).
///
/// @param image     BGR pixels
/// @param reference the reference color c0
/// @param threshold skin where Δ > threshold, in [-1, 1]
/// @param region    where to look, clipped to the image
/// @returns         (6,): count, mean x, mean y (pixels), var xx, var yy, cov xy (pixels^2); 0 without skin
/// @throws std::invalid_argument on a threshold outside [-1, 1]
/// Source: Sabeti, Parvizi, Wu 2008, equations (5)-(16).
Vector skin_moments(const ImageView& image, const Bgr& reference, double threshold, const Region& region);

}  // namespace tricue
