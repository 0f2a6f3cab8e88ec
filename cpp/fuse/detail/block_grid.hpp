// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/arrays.hpp"
#include "base/depth_pixels.hpp"
#include "base/region.hpp"

namespace tricue {

using BlockNumbers = Eigen::Ref<const Indices>;

/// The place of a grid of blocks: corners are `size` times those in the grid, plus (x, y), minus (left, top).
struct GridPlace {
    double size, x, y, left, top;
};

/// The target's blocks, which move with it and grow as it comes nearer.
struct BlockGrid {
    StatesRef corners;  ///< float64 (N, 4): x0, y0, x1, y1 of each block
    /// (size, x, y, left, top), finite: a corner c is at size c + (x, y) - (left, top), pixels
    GridPlace place;
};

/// The pixels of each block in an image: those whose centers lie in it.
///
/// @throws std::invalid_argument unless corners are (N, 4), and all finite where they are placed
std::vector<Region> block_pixels(const BlockGrid& grid, int rows, int cols);

/// (rows, cols) 1 in the pixels of some blocks, else 0.
Labels mask_regions(const std::vector<Region>& blocks, int rows, int cols);

/// @throws std::invalid_argument unless there is a number for each block
void require_numbers(const BlockGrid& grid, BlockNumbers numbers, const char* name);

}  // namespace tricue
