// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/float_planes.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Histograms of oriented gradients (HOG), texture and colors of a patch in cells of 2 x 2 pixels: the features of a correlation
/// filter.
///
/// A pixel's gradient g is the longest of its channels' central differences, the first of equals; the patch's edge pixels are
/// repeated. Bin k of eight stands for gradients toward 45 k degrees, x to the right and y down. With a the longer side of g and
/// b the shorter, (b / a) |g| goes to the nearest diagonal bin and the rest to the nearest straight one. Pixels are shared among
/// the cells around them by bilinear weights: s_k is the sum of bin k over the 4 x 4 pixels around a cell, with the weights (1,
/// 3, 3, 1) / 4 along each axis; pixels outside the patch count as 0. From these follow
///     u_k = s_k + s_{k+4}, k = 0..3, for gradients of either sign,
///     E = Σ u_k², the cell's energy,
///     n_j = 1 / sqrt(Σ E + 102²) over the 2 x 2 cells of block j, which contains the cell.
///
/// j = 0..3 is the block to the upper left, upper right, lower left and lower right; where it extends beyond the patch, the
/// outermost cells are repeated. The 102 gray levels keep noise from being raised to full contrast. The planes:
///     0 to 7      Σ_j min(s_k n_j, 0.2) / 2
///     8 to 11     Σ_j min(u_k n_j, 0.2) / 2
///     12 to 15    0.2357 Σ_k min(s_k n_j, 0.2), for each j: texture
///     16 to 18    B, G, R in [0, 1], means of a cell's four pixels, minus their means over the patch
///
/// Last, all planes are multiplied by the taper. All but the means is computed in float32, in this order: b / a before its
/// product with |g|; sums over 4 x 4 pixels as ((first + fourth) + 3 (second + third)), of columns first, then of rows, times 1 /
/// 16; sums over blocks of columns first, then of rows; sums over k and j upward.
///
/// @param patch uint8 (2R, 2C, 3) BGR
/// @param taper float32 (R, C), at least one cell
/// @returns float32 (19, R, C)
/// @throws std::invalid_argument on a patch of another size, or no cells
/// Source: Dalal, Triggs 2005, section 6; Felzenszwalb, Girshick, McAllester, Ramanan 2010, section 6. Cells of 2 x 2 pixels,
/// eight bins by the ratio of the sides, the 102 levels and the colors are ours.
FloatPlanes hog_color_cells(const ImageView& patch, FloatsRef taper);

}  // namespace tricue
