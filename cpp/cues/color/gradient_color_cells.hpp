// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Gradient orientations and colors of a patch in cells of 2 x 2 pixels: the features of a correlation filter.
///
/// Planes 0 to 7: gradients towards 45 k degrees, x to the right and y down. A pixel's gradient g is a central difference with the
/// edge repeated, of the channel where it is longest, the first of equals. With a its longer side and b the shorter, |g| b / a goes
/// to the nearest diagonal bin and the rest to the nearest straight one. The sums c_k over a cell's four pixels become
///     min(c_k / sqrt(Σ c_l² over the 3 x 3 cells around + 32²), 0.4)
///
/// where outside the patch its outermost cells are repeated; 32 levels keep noise from full contrast. Planes 8 to 10: B, G, R in
/// [0, 1], minus their means over the patch. All planes are multiplied by the taper. All but the means is float32, summed over
/// columns first, then over rows, and over bins upwards.
///
/// @param patch uint8 (2R, 2C, 3) BGR
/// @param taper float32 (R, C), at least one cell
/// @returns float32 (11, R, C); in C++ the planes one below the other
/// @throws std::invalid_argument on a patch of another size, or no cells
/// Source: Dalal, Triggs 2005, section 6; cells, colors and constants are ours.
Floats gradient_color_cells(const ImageView& patch, FloatsRef taper);

}  // namespace tricue
