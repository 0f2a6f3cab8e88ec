// SPDX-License-Identifier: MIT
#include "cues/color/image_mean.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kBlock = 32;  // pixels that are added side by side
constexpr int kLanes = 3 * kBlock;
constexpr int kMaxBlocks = 257;  // of bytes whose sum fits 16 bits
constexpr int kPrefetchRows = 2;

TRICUE_MULTIVERSION
void add_blocks(const std::uint8_t* __restrict bytes, int blocks, std::uint16_t* __restrict sums) {
    for (int i = 0; i < blocks; ++i, bytes += kLanes)
        for (int lane = 0; lane < kLanes; ++lane)
            sums[lane] = static_cast<std::uint16_t>(sums[lane] + bytes[lane]);
}

/// Sums of pixels side by side, which are added up before they overflow.
class BlockSums {
public:
    void add(const std::uint8_t* row, int cols) {
        for (int left = cols / kBlock; left > 0;) {
            const int blocks = std::min(left, kMaxBlocks - added_);
            add_blocks(row, blocks, sums_.data());
            row += kLanes * blocks;
            left -= blocks;
            if ((added_ += blocks) == kMaxBlocks) flush();
        }
        const auto rest = static_cast<std::size_t>(3 * (cols % kBlock));
        for (std::size_t i = 0; i < rest; ++i) total_[i % 3] += row[i];
    }

    /// The sums of blue, green and red.
    const std::array<std::uint64_t, 3>& total() {
        flush();
        return total_;
    }

private:
    void flush() {
        for (std::size_t lane = 0; lane < sums_.size(); ++lane) total_[lane % 3] += sums_[lane];
        sums_.fill(0);
        added_ = 0;
    }

    std::array<std::uint16_t, kLanes> sums_{};
    std::array<std::uint64_t, 3> total_{};
    int added_ = 0;
};

}  // namespace

Vector image_mean(const ImageView& image) {
    BlockSums sums;
    for (int y = 0; y < image.rows; ++y) {
        if (y + kPrefetchRows < image.rows)
            prefetch_bytes(image.row(y + kPrefetchRows), 3 * std::ptrdiff_t{image.cols});
        sums.add(image.row(y), image.cols);
    }
    const double pixels = static_cast<double>(image.rows) * image.cols;
    const double share = pixels > 0.0 ? 1.0 / pixels : 0.0;
    const auto& [blue, green, red] = sums.total();
    Vector mean(3);
    mean << static_cast<double>(blue) * share, static_cast<double>(green) * share,
        static_cast<double>(red) * share;
    return mean;
}

}  // namespace tricue
