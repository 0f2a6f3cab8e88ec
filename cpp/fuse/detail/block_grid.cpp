// SPDX-License-Identifier: MIT
#include "fuse/detail/block_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

/// The first pixels, in [0, rows or cols], whose centers aren't below the edges x, y, x, y of n blocks. Returns how many edges
/// aren't finite.
TRICUE_MULTIVERSION
int find_edges(const double* __restrict corners, const GridPlace& place, double rows, double cols, int n,
               Region* __restrict blocks) {
    static_assert(sizeof(Region) == 4 * sizeof(int));  // x0, y0, x1, y1
    int* __restrict edges = reinterpret_cast<int*>(blocks);
    constexpr double kMax = std::numeric_limits<double>::max();
    const double size = place.size, x = place.x, y = place.y, left = place.left, top = place.top;
    int strange = 0;
    for (int i = 0; i < 2 * n; ++i) {
        const double across = corners[2 * i] * size + x - left, down = corners[2 * i + 1] * size + y - top;
        const double column = std::ceil(across - 0.5), row = std::ceil(down - 0.5);
        strange += !(std::abs(across) <= kMax) | !(std::abs(down) <= kMax);
        const double not_left = column > 0.0 ? column : 0.0, not_above = row > 0.0 ? row : 0.0;
        edges[2 * i] = static_cast<int>(not_left < cols ? not_left : cols);
        edges[2 * i + 1] = static_cast<int>(not_above < rows ? not_above : rows);
    }
    return strange;
}

}  // namespace

std::vector<Region> block_pixels(const BlockGrid& grid, int rows, int cols) {
    require_shape(grid.corners, grid.corners.rows(), 4, "corners");
    const auto count = static_cast<int>(grid.corners.rows());
    std::vector<Region> blocks(static_cast<std::size_t>(count));
    const int strange = find_edges(grid.corners.data(), grid.place, rows, cols, count, blocks.data());
    if (strange > 0)
        refuse("corners", "finite numbers, where they are placed", std::to_string(strange) + " others");
    for (Region& block : blocks) {
        block.x1 = std::max(block.x0, block.x1);
        block.y1 = std::max(block.y0, block.y1);
    }
    return blocks;
}

Labels mask_regions(const std::vector<Region>& blocks, int rows, int cols) {
    Labels mask = Labels::Zero(rows, cols);
    for (const Region& part : blocks)
        for (int y = part.y0; y < part.y1; ++y)
            std::fill(mask.row(y).data() + part.x0, mask.row(y).data() + part.x1, std::uint8_t{1});
    return mask;
}

void require_numbers(const BlockGrid& grid, BlockNumbers numbers, const char* name) {
    const Eigen::Index count = grid.corners.rows();
    if (numbers.size() != count)
        refuse(name, std::to_string(count) + " numbers", std::to_string(numbers.size()));
}

}  // namespace tricue
