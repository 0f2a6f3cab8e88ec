// SPDX-License-Identifier: MIT
#include "cues/color/image_mean.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kBlock = 32;         // pixels that are added side by side
constexpr int kLanes = 3 * kBlock;
constexpr int kMaxBlocks = 257;    // of bytes whose sum fits 16 bits
constexpr int kPrefetchRows = 2;

/// The sums of a row's levels: blue, green and red by turns.
TRICUE_MULTIVERSION
void add_blocks(const std::uint8_t* __restrict bytes, int blocks, std::uint64_t* total) {
    std::uint16_t sums[kLanes] = {};
    for (int i = 0; i < blocks; ++i, bytes += kLanes)
        for (int lane = 0; lane < kLanes; ++lane)
            sums[lane] = static_cast<std::uint16_t>(sums[lane] + bytes[lane]);
    for (int lane = 0; lane < kLanes; ++lane) total[lane % 3] += sums[lane];
}

void add_row(const std::uint8_t* row, int cols, std::uint64_t* total) {
    for (int left = cols / kBlock; left > 0;) {
        const int blocks = std::min(left, kMaxBlocks);
        add_blocks(row, blocks, total);
        row += kLanes * blocks;
        left -= blocks;
    }
    const int rest = 3 * (cols % kBlock);
    for (int i = 0; i < rest; ++i) total[i % 3] += row[i];
}

}  // namespace

Vector image_mean(const ImageView& image) {
    std::array<std::uint64_t, 3> total{};
    for (int y = 0; y < image.rows; ++y) {
        if (y + kPrefetchRows < image.rows)
            prefetch_bytes(image.row(y + kPrefetchRows), 3 * std::ptrdiff_t{image.cols});
        add_row(image.row(y), image.cols, total.data());
    }
    const double pixels = static_cast<double>(image.rows) * image.cols;
    const double share = pixels > 0.0 ? 1.0 / pixels : 0.0;
    Vector mean(3);
    for (std::size_t c = 0; c < 3; ++c)
        mean[static_cast<Eigen::Index>(c)] = static_cast<double>(total[c]) * share;
    return mean;
}

}  // namespace tricue
