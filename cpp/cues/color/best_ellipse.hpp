// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/detail/bins_view.hpp"
#include "cues/color/detail/search_grid.hpp"
#include "cues/color/ellipse_search.hpp"

namespace tricue {

/// Weights of the terms of a place's score besides the ellipse's intersection.
struct ScoreWeights {
    double ring;        ///< weight of the ring's intersection, subtracted
    double depth;       ///< weight of the marked share
    double depth_ring;  ///< weight of the ring's marked share, subtracted from the ellipse's
};

/// The best place, and its colors.
struct BestEllipse {
    int row, col;         ///< of its place in the grid
    double score;         ///< the greatest
    double intersection;  ///< (1) of the ellipse there
    double marked;        ///< the share of its pixels that the mask marks
    Vector histogram;     ///< float64 (L,) of sum 1, its colors; 0 where it has no pixel
};

/// The place of a grid where an ellipse matches a model best, and the ellipse's colors there.
///
/// With i and a the intersections (1) of ellipse and ring, m and n their marked shares, as ellipse_search gives them, a place scores
///     i - ring a + depth (m - depth_ring n)
///
/// Of equal scores the first wins, row by row. The colors are those of the ellipse's marked pixels, or, where these are fewer
/// than min_marked, of all its pixels.
///
/// @param bins uint16 (H, W), as color_bins gives them, each below L, or 65535 for none; may be empty
/// @param ellipse float64 (4,): center x, y, semi-axes along x (minor) and y (major), pixels of the bins, finite, axes above 0
/// @param grid (rows, cols, step), as ellipse_search takes it
/// @param model float64 (L,), finite, none negative, a sum above 0
/// @param margin scale of the ring's outline, 1 (no ring) to 16; scaled semi-axes are at most 4096 pixels
/// @param mask uint8 (H, W), not 0 where a pixel is at the target's depth
/// @param weights (ring, depth, depth_ring), finite
/// @param min_marked pixels; 0: the colors are those of all pixels of the ellipse
/// @throws std::invalid_argument on other shapes or values, or a grid that spans more than 16384 pixels
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.1: M and C of equation (1); ring and mask are ours.
BestEllipse best_ellipse(const BinsView& bins, VectorRef ellipse, const SearchGrid& grid,
                         const SearchModel& model, const ImageView& mask, const ScoreWeights& weights,
                         int min_marked);

}  // namespace tricue
