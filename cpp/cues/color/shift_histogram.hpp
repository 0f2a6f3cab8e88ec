// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/color/detail/color_space.hpp"

namespace tricue {

/// Moves a color histogram as a whole, so that its mean becomes a given one.
///
/// Along each axis the mass of a bin is split in proportion between the two bins around its new place, so among eight in all.
/// Mass that would leave an axis stays in its end bin: the sum never changes, and the mean is met unless mass was clamped.
///
/// @param histogram float64 (L,), L = n_0 n_1 n_2, in the order of color_bins; finite, none negative, a sum above 0
/// @param mean float64 (3,): B - G, G - R, B + G + R, color levels, as histogram_mean gives it; finite
/// @returns float64 (L,) of the same sum
/// @throws std::invalid_argument on other sizes or values
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 4: the filter's μ goes back to the histogram; how is ours.
Vector shift_histogram(VectorRef histogram, const ColorSpace& space, VectorRef mean);

}  // namespace tricue
