// SPDX-License-Identifier: MIT
#pragma once

#include "base/region.hpp"

namespace tricue {

/// Positions to try: rows x cols of them, `step` pixels apart. Position (i, j) is (j - cols / 2) step to the right and (i - rows / 2)
/// step below the ellipse's own, halves rounded down: 4 x 16 are ±2 x ±8 without the last row and column.
struct SearchGrid {
    int rows, cols, step;
};

/// Throws std::invalid_argument unless rows, cols and step are 1 to 1024 and the grid spans at most 16384 pixels.
void require_grid(const SearchGrid& grid);

/// The pixels that a region covers when it is moved to all positions of a grid.
Region swept_region(const Region& region, const SearchGrid& grid);

}  // namespace tricue
