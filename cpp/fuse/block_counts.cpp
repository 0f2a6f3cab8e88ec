// SPDX-License-Identifier: MIT
#include "fuse/block_counts.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "check.hpp"
#include "rectangle_pixels.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

/// Of each column of a block: rows down, columns are summed side by side.
struct Columns {
    double* sums;
    std::int32_t *readings, *targets;
};

TRICUE_MULTIVERSION
void add_block(const float* disparity, std::ptrdiff_t disparity_stride, const std::uint8_t* mask,
               std::ptrdiff_t mask_stride, int rows, int cols, const Columns& columns) {
    constexpr float kMost = std::numeric_limits<float>::max();
    double* __restrict sums = columns.sums;
    std::int32_t* __restrict readings = columns.readings, * __restrict targets = columns.targets;
    for (int y = 0; y < rows; ++y, disparity += disparity_stride, mask += mask_stride)
        for (int x = 0; x < cols; ++x) {
            const bool read = std::abs(disparity[x]) <= kMost;
            sums[x] += static_cast<double>(read ? disparity[x] : 0.0f);
            readings[x] += read;
            targets[x] += mask[x] != 0;
        }
}

/// The sums over a block's columns.
struct Totals {
    double sum = 0.0;
    std::int64_t readings = 0, targets = 0;
};

Totals total(const Columns& columns, int cols) {
    Totals totals;
    for (int x = 0; x < cols; ++x) {
        totals.sum += columns.sums[x];
        totals.readings += columns.readings[x];
        totals.targets += columns.targets[x];
    }
    return totals;
}

}  // namespace

BlockCounts block_counts(const ImageView& mask, const PlaneView& disparity, StatesRef blocks) {
    const auto shape = [](int rows, int cols) {
        return "(" + std::to_string(rows) + ", " + std::to_string(cols) + ")";
    };
    if (mask.rows != disparity.rows || mask.cols != disparity.cols)
        refuse("mask", "shape " + shape(disparity.rows, disparity.cols), shape(mask.rows, mask.cols));
    require_shape(blocks, blocks.rows(), 4, "blocks");
    const auto width = static_cast<std::size_t>(disparity.cols);
    std::vector<double> sums(width);
    std::vector<std::int32_t> readings(width), targets(width);
    const Columns columns{sums.data(), readings.data(), targets.data()};
    const Eigen::Index count = blocks.rows();
    BlockCounts seen{Indices(count), Indices(count), Indices(count), Vector(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto block = blocks.row(i);
        const Region part = rectangle_pixels({block[0], block[1], block[2], block[3]}, disparity.rows,
                                             disparity.cols, "blocks");
        const int rows = part.y1 - part.y0, cols = part.x1 - part.x0;
        std::fill_n(sums.begin(), cols, 0.0);
        std::fill_n(readings.begin(), cols, 0);
        std::fill_n(targets.begin(), cols, 0);
        if (rows > 0 && cols > 0)
            add_block(disparity.row(part.y0) + part.x0, disparity.stride, mask.row(part.y0) + part.x0,
                      mask.stride, rows, cols, columns);
        const Totals totals = total(columns, cols);
        const auto read = static_cast<double>(totals.readings);
        seen.pixels[i] = std::int64_t{rows} * cols;
        seen.targets[i] = totals.targets;
        seen.readings[i] = totals.readings;
        seen.mean[i] = read > 0.0 ? totals.sum / read : std::numeric_limits<double>::quiet_NaN();
    }
    return seen;
}

}  // namespace tricue
