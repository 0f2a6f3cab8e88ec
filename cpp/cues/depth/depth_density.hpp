// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// The density p(z) of depth levels: a histogram, divided by its sum, smoothed by a Gaussian kernel.
///
/// The kernel exp(-(j / bandwidth)² / 2) is cut at |j| = ceil(4 bandwidth) and of sum 1. What it carries over an end
/// comes back as from a mirror at the edge of the outermost level, so the density's sum is 1 too.
///
/// @param histogram (L,), finite, none negative, L at least 1: how many pixels have each level
/// @param bandwidth levels, in (0, L]
/// @returns         (L,) of sum 1; all 0 where the histogram is
/// @throws std::invalid_argument on another histogram or bandwidth, or a sum that isn't finite
/// Source: Sabeti, Parvizi, Wu 2008, section IV.A, p(z) of equation (32).
Vector depth_density(VectorRef histogram, double bandwidth);

}  // namespace tricue
