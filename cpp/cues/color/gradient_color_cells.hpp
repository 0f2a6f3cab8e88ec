// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Orientations and colors of a patch in cells of 2 x 2 pixels, as a correlation filter reads them.
///
/// Planes 0 to 7: bin k is for gradients towards 45 k degrees, x to the right and y down. A pixel's gradient g, central differences
/// with the edge repeated, is that of the channel where it is longest, the first of equals. It is shared out between the two nearest
/// bins without an arctangent: of its longer side a and the shorter one b the diagonal bin gets |g| b / a, the straight one
/// the rest (in a bin of its own direction it is all of it). A cell's sums c_k are over its four pixels. They become
///     min(c_k / sqrt(sum of all c_l² of the 3 x 3 cells around + 32²), 0.4),
/// outside the patch its outermost cells again; 32 levels, so that noise isn't blown up to full contrast.
///
/// Planes 8 to 10: blue, green, red in [0, 1], minus their means over the patch. All are multiplied by the taper.
///
/// All in float32 in this order: sums over a cell, and over 3 x 3 cells, the columns first; over bins upwards.
///
/// @param patch uint8 BGR, 2 R x 2 C
/// @param taper R x C, at least one cell
/// @returns     11 R x C: the planes one below the other
/// @throws std::invalid_argument on a patch of another size, and without cells
/// Source: Dalal and Triggs 2005, section 6; cells, colors and constants are ours.
Floats gradient_color_cells(const ImageView& patch, FloatsRef taper);

}  // namespace tricue
