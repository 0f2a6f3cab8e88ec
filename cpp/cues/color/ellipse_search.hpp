// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/detail/bins_view.hpp"
#include "cues/color/detail/search_grid.hpp"

namespace tricue {

/// How an ellipse is searched: the model histogram (L,), and how much larger than the ellipse the ring's outline is.
struct SearchModel {
    VectorRef histogram;
    double margin;
};

/// The intersection of a model with the histogram of an ellipse, at every place of a grid, and of the ring round it.
///
/// (1) is Σ min(C_i, n M_i) / n, where n = Σ C_i pixels are inside the ellipse and inside the image, and M is of sum 1: what is
/// outside the image neither counts for a place nor against it, so a head at the edge has its maximum where it is. Nothing
/// inside gives 0. The search walks to and fro over the grid pixel by pixel: only those of the outline leave and enter, and the
/// counts at every place are those of ellipse_histogram to the pixel. n M_i is rounded to 2^-k pixels, k the most with which n
/// pixels fit into 31 bits (20 for a thousand), so that (1) is summed in whole numbers: it's off by 2^-(k+1) a bin at most.
///
/// @param bins    (H, W), below L or 65535 for none; may be empty
/// @param ellipse (4,): centre x, y, semi-axes along x (minor) and along y (major), pixels of the bins, finite, above 0
/// @param grid    of places round the ellipse's own
/// @param model   finite, none negative, a sum above 0; margin 1 (no ring) to 16, times the semi-axes at most 4096 pixels
/// @param mask    (H, W) like bins, not 0 where a pixel is coherent in depth; data nullptr for none
/// @returns       (rows cols, 4), place by place, row by row: (1) of the ellipse, of the ring, the shares of the pixels of the
///                ellipse and of the ring that the mask marks, pixels outside the image left out as above
/// @throws std::invalid_argument on other shapes or values
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, equation (1) and section 3.1; the ring and the mask are ours.
States ellipse_search(const BinsView& bins, VectorRef ellipse, const SearchGrid& grid,
                      const SearchModel& model, const ImageView& mask);

}  // namespace tricue
