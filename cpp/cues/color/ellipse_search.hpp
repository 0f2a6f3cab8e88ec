// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/detail/bins_view.hpp"
#include "cues/color/detail/search_grid.hpp"

namespace tricue {

/// The histogram that an ellipse is searched with, and the ring around the ellipse.
struct SearchModel {
    VectorRef histogram;
    /// scale of the ring's outline, 1 (no ring) to 16; scaled semi-axes are at most 4096 pixels
    double margin;
};

/// Histogram intersection of a model with the ellipse at each place of a grid, and with the ring around it.
///
/// Equation (1) is Σ min(C_i, n M_i) / n, n = Σ C_i, where C_i counts the pixels of bin i and M is scaled to sum 1; it is 0 where
/// n is 0. A pixel is inside if its center (column + 0.5, row + 0.5) is. The ring is the ellipse scaled by `margin`, without the
/// ellipse. Pixels outside the image, and those without a bin, count neither for nor against a place, so a head at the image's
/// edge has its maximum at its true place. n M_i is rounded to 2^-k pixels, k the largest with which n pixels fit into 31 bits,
/// so (1) is off by at most 2^-(k+1) per bin.
///
/// @param bins uint16 (H, W), as color_bins gives them, each below L, or 65535 for none; may be empty
/// @param ellipse float64 (4,): center x, y, semi-axes along x (minor) and y (major), pixels of the bins, finite, axes above 0
/// @param grid (rows, cols, step), 1 to 1024 each: place (i, j) is j - cols // 2 steps to the right of the ellipse and i - rows // 2
///     steps below it; a step is so many pixels
/// @param model float64 (L,), finite, none negative, a sum above 0
/// @param mask uint8 (H, W), not 0 where a pixel is at the target's depth; None for none
/// @returns float64 (rows, cols, 4): (1) of the ellipse and of the ring, then the shares of the pixels of the ellipse and of the
///     ring that the mask marks, 0 without a mask; in C++ one row per place
/// @throws std::invalid_argument on other shapes or values, or a grid that spans more than 16384 pixels
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, equation (1) and section 3.1; the ring and the mask are ours.
States ellipse_search(const BinsView& bins, VectorRef ellipse, const SearchGrid& grid,
                      const SearchModel& model, const ImageView& mask);

}  // namespace tricue
