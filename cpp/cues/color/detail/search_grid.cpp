// SPDX-License-Identifier: MIT
#include "cues/color/detail/search_grid.hpp"

#include <algorithm>
#include <string>

#include "base/check.hpp"

namespace tricue {

void require_grid(const SearchGrid& grid) {
    const auto [least, most] = std::minmax({grid.rows, grid.cols, grid.step});
    if (least < 1 || most > 1024 || std::max(grid.rows, grid.cols) * grid.step > 16384)
        refuse("grid", "rows, cols and a step of 1 to 1024, over at most 16384 pixels",
               "(" + std::to_string(grid.rows) + ", " + std::to_string(grid.cols) + ", " +
                   std::to_string(grid.step) + ")");
}

Region swept_region(const Region& region, const SearchGrid& grid) {
    const int left = grid.cols / 2, up = grid.rows / 2;
    return {region.x0 - left * grid.step, region.y0 - up * grid.step,
            region.x1 + (grid.cols - 1 - left) * grid.step, region.y1 + (grid.rows - 1 - up) * grid.step};
}

}  // namespace tricue
