// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/color/detail/color_space.hpp"

namespace tricue {

/// The mean color of a histogram over the space (B - G, G - R, B + G + R): μ of the state.
///
/// A bin stands for the mean of the whole levels in it: with as many bins as levels it is the mean of the pixels.
///
/// @param histogram (L,) as color_bins numbers it, L the bins of the space; finite, none negative, a sum above 0
/// @returns         (3,) color units
/// @throws std::invalid_argument on another size or values
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, μ of equation (7).
Vector histogram_mean(VectorRef histogram, const ColorSpace& space);

}  // namespace tricue
