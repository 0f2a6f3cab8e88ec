// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// Density p(z) of depth levels: a histogram divided by its sum, smoothed by a Gaussian.
///
/// The kernel exp(-(j / bandwidth)² / 2) is cut at |j| = ceil(4 bandwidth) and normalized. What it spreads beyond an end is
/// mirrored at the edge of the outermost level, so the density's sum is 1, too.
///
/// @param histogram float64 (L,), L at least 1, finite, none negative: pixels of each level
/// @param bandwidth levels, in (0, L]
/// @returns float64 (L,) of sum 1; all 0 where the histogram is
/// @throws std::invalid_argument on another histogram or bandwidth, or a sum that is not finite
/// Source: Sabeti, Parvizi, Wu 2008, section IV.A, p(z) of equation (32).
Vector depth_density(VectorRef histogram, double bandwidth);

}  // namespace tricue
