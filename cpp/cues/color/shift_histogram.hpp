// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/color/detail/color_space.hpp"

namespace tricue {

/// A histogram moved as a whole so that its mean becomes a given one.
///
/// Along each axis the mass of a bin goes to the two bins that it comes to lie between, in proportion: to eight in the space. What
/// would leave an axis stays in its end bin, so the sum never changes, and the mean is met unless something was held back.
///
/// @param histogram (L,) as color_bins numbers it, L the bins of the space; finite, none negative, a sum above 0
/// @param mean      (3,) color units, as histogram_mean gives it; finite
/// @returns         (L,)
/// @throws std::invalid_argument on other sizes or values
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 4: the filter's μ goes back to the histogram; how, is ours.
Vector shift_histogram(VectorRef histogram, const ColorSpace& space, VectorRef mean);

}  // namespace tricue
