// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/color/detail/color_space.hpp"

namespace tricue {

/// Mean color (B - G, G - R, B + G + R) of a histogram over that space.
///
/// A bin stands for the mean of the whole levels in it: with as many bins as levels the result is the mean of the pixels.
///
/// @param histogram float64 (L,), L = n_0 n_1 n_2, in the order of color_bins; finite, none negative, a sum above 0
/// @returns float64 (3,), color levels
/// @throws std::invalid_argument on another size or other values
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, μ of equation (7).
Vector histogram_mean(VectorRef histogram, const ColorSpace& space);

}  // namespace tricue
