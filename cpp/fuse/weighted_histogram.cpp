// SPDX-License-Identifier: MIT
#include "fuse/weighted_histogram.hpp"

#include <limits>
#include <vector>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"
#include "fuse/detail/rectangle_pixels.hpp"

namespace tricue {
namespace {

// Neighbors mostly share a bin, and reading a sum that was just written is slow, so neighbors are summed in
// different tables.
constexpr std::size_t kTables = 4;

/// Sets weights that do not count to 0. Without a mask, `mask` is null.
TRICUE_MULTIVERSION
void keep_weights(const float* __restrict weights, const std::uint8_t* __restrict mask, int n,
                  float* __restrict kept) {
    constexpr float kMaxFloat = std::numeric_limits<float>::max();
    if (mask == nullptr)
        for_overlapping_blocks<16>(n, [=](std::ptrdiff_t x) {
            const float weight = weights[x];
            kept[x] = (weight > 0.0f) & (weight <= kMaxFloat) ? weight : 0.0f;
        });
    else
        for_overlapping_blocks<16>(n, [=](std::ptrdiff_t x) {
            const float weight = weights[x];
            kept[x] = (weight > 0.0f) & (weight <= kMaxFloat) & (mask[x] != 0) ? weight : 0.0f;
        });
}

/// Adds a row's weights to the tables of `size` bins; the last bin is for values without one.
void add_row(const std::vector<std::int32_t>& bin, const std::vector<float>& weight, std::size_t size,
             double* sums) {
    for (std::size_t x = 0; x < bin.size(); x += kTables)
        for (std::size_t t = 0; t < kTables; ++t)
            sums[t * size + static_cast<std::size_t>(bin[x + t])] += static_cast<double>(weight[x + t]);
}

}  // namespace

Vector weighted_histogram(const PlaneView& values, const PlaneView& weights, const Rectangle& region,
                          const ValueRange& range, const ImageView& mask) {
    require_same_shape(weights, values, "weights");
    if (mask.data != nullptr) require_same_shape(mask, values, "mask");
    require_range(range);
    const Region visible = rectangle_pixels(region, values.rows, values.cols, "region");
    const int cols = visible.x1 - visible.x0;
    const std::size_t size = static_cast<std::size_t>(range.bins) + 1;
    const auto padded = (static_cast<std::size_t>(cols) + kTables - 1) / kTables * kTables;
    std::vector<std::int32_t> bin(padded, range.bins);
    std::vector<float> weight(padded);
    std::vector<double> sums(kTables * size);
    const FloatRange bins(range);
    for (int y = visible.y0; y < visible.y1; ++y) {
        find_value_bins(values.row(y) + visible.x0, cols, bins, bin.data());
        keep_weights(weights.row(y) + visible.x0, mask.data == nullptr ? nullptr : mask.row(y) + visible.x0,
                     cols, weight.data());
        add_row(bin, weight, size, sums.data());
    }
    Vector histogram(range.bins);
    for (std::size_t i = 0; i + 1 < size; ++i)
        histogram[static_cast<Eigen::Index>(i)] =
            (sums[i] + sums[size + i]) + (sums[2 * size + i] + sums[3 * size + i]);
    return histogram;
}

}  // namespace tricue
