// SPDX-License-Identifier: MIT
#include "cues/color/skin_moments.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/simd.hpp"
#include "cues/color/skin_boundary.hpp"

namespace tricue {
namespace {

// In tiles of this size every inner sum has 16-bit factors and a 32-bit total.
constexpr int kTile = 1024;
constexpr int kPrefetchRows = 4;
using TileRow = std::array<std::int16_t, kTile>;

constexpr TileRow ascending() {
    TileRow row{};
    for (int x = 0; x < kTile; ++x) row[static_cast<std::size_t>(x)] = static_cast<std::int16_t>(x);
    return row;
}
constexpr TileRow kColumn = ascending();

struct RowSums {
    int count, x;
};

/// Raw moments of integer pixel indices, relative to the region's corner; exact.
struct Sums {
    std::int64_t count = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
};

/// Counts one row's skin and adds it to the counts of the columns.
TRICUE_MULTIVERSION
RowSums sum_row(const std::int16_t* __restrict boundary, int n, std::int16_t least,
                std::int16_t* __restrict columns) {
    int count = 0, sum = 0;
    for (int x = 0; x < n; ++x) {
        const std::int16_t skin = boundary[x] >= least;
        count += skin;
        sum += skin * kColumn[static_cast<std::size_t>(x)];
        columns[x] = static_cast<std::int16_t>(columns[x] + skin);
    }
    return {count, sum};
}

void add_tile(const ImageView& image, const Bgr& reference, std::int16_t least, const Region& region,
              const Region& tile, Sums& sums) {
    const int width = tile.x1 - tile.x0;
    const std::int64_t left = tile.x0 - region.x0;
    TileRow boundary, columns{};
    for (int row = tile.y0; row < tile.y1; ++row) {
        if (row + kPrefetchRows < tile.y1)
            prefetch_bytes(image.row(row + kPrefetchRows) + 3 * std::ptrdiff_t{tile.x0}, 3 * width);
        skin_boundary_row(image.row(row) + 3 * std::ptrdiff_t{tile.x0}, width, reference, boundary.data());
        const RowSums skin = sum_row(boundary.data(), width, least, columns.data());
        const std::int64_t y = row - region.y0, x = skin.x + left * skin.count;
        sums.count += skin.count;
        sums.y += y * skin.count;
        sums.yy += y * y * skin.count;
        sums.xy += y * x;
        sums.x += x;
    }
    for (int column = 0; column < width; ++column) {
        const std::int64_t x = left + column;
        sums.xx += x * x * columns[static_cast<std::size_t>(column)];
    }
}

}  // namespace

Vector skin_moments(const ImageView& image, const Bgr& reference, double threshold, const Region& region) {
    const auto least = static_cast<std::int16_t>(least_skin(threshold));
    const Region visible = region.clipped(image);
    Sums sums;
    for (int y = visible.y0; y < visible.y1; y += kTile)
        for (int x = visible.x0; x < visible.x1; x += kTile) {
            const Region tile{x, y, std::min(x + kTile, visible.x1), std::min(y + kTile, visible.y1)};
            add_tile(image, reference, least, visible, tile, sums);
        }

    Vector moments = Vector::Zero(6);
    if (sums.count == 0) return moments;
    const auto count = static_cast<double>(sums.count);
    const auto average = [count](std::int64_t sum) { return static_cast<double>(sum) / count; };
    const double x = average(sums.x), y = average(sums.y);
    moments << count, visible.x0 + x + 0.5, visible.y0 + y + 0.5, average(sums.xx) - x * x,
        average(sums.yy) - y * y, average(sums.xy) - x * y;
    return moments;
}

}  // namespace tricue
