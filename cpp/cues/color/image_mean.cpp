// SPDX-License-Identifier: MIT
#include "cues/color/image_mean.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

using Sums = std::array<std::uint64_t, 3>;

constexpr int kMaxDenseStep = 8;    ///< above it, selecting pixels is faster than adding all of a row
constexpr int kBlock = 32;          ///< smallest number of pixels that are added side by side
constexpr int kMaxAdditions = 257;  ///< of bytes whose sum fits 16 bits

/// kSize is the size, or 0 for any size: with a known size, sums stay in registers.
template <int kSize>
TRICUE_INLINE void add(const std::uint8_t* __restrict bytes, int blocks, int any_size,
                       std::uint16_t* __restrict sums) {
    const int size = kSize > 0 ? kSize : any_size;
    for (int i = 0; i < blocks; ++i, bytes += size)
        for (int k = 0; k < size; ++k) sums[k] = static_cast<std::uint16_t>(sums[k] + bytes[k]);
}

TRICUE_MULTIVERSION
void add_blocks(const std::uint8_t* bytes, int blocks, int size, std::uint16_t* sums) {
    size == 3 * kBlock ? add<3 * kBlock>(bytes, blocks, size, sums) : add<0>(bytes, blocks, size, sums);
}

/// Sums of samples: all pixels are summed in blocks, and only the sums at samples are used.
class BlockSums {
public:
    explicit BlockSums(int step)
        : step_(step),
          pixels_((kBlock + step - 1) / step * step),
          sums_(3 * static_cast<std::size_t>(pixels_), 0) {}

    void add(const std::uint8_t* row, int cols, Sums& total) {
        const int size = 3 * pixels_;
        int x = 0;
        for (int left = cols / pixels_; left > 0;) {
            const int blocks = std::min(left, kMaxAdditions - additions_);
            add_blocks(row + 3 * x, blocks, size, sums_.data());
            x += blocks * pixels_;
            left -= blocks;
            if ((additions_ += blocks) == kMaxAdditions) flush(total);
        }
        for (x += step_ / 2; x < cols; x += step_)
            for (std::size_t c = 0; c < 3; ++c) total[c] += row[3 * static_cast<std::size_t>(x) + c];
    }

    void flush(Sums& total) {
        for (auto x = static_cast<std::size_t>(step_ / 2); 3 * x < sums_.size();
             x += static_cast<std::size_t>(step_))
            for (std::size_t c = 0; c < 3; ++c) total[c] += sums_[3 * x + c];
        std::fill(sums_.begin(), sums_.end(), std::uint16_t{0});
        additions_ = 0;
    }

private:
    int step_, pixels_, additions_ = 0;
    std::vector<std::uint16_t> sums_;
};

/// The image as one long row if its rows follow each other: they needn't be added one by one if all pixels are.
ImageView joined_rows(const ImageView& image) {
    const std::int64_t pixels = std::int64_t{image.rows} * image.cols;
    const bool joined =
        image.stride == 3 * std::ptrdiff_t{image.cols} && pixels <= std::numeric_limits<int>::max() / 3;
    return joined ? ImageView{image.data, 1, static_cast<int>(pixels), 3, 3 * pixels} : image;
}

}  // namespace

Vector image_mean(const ImageView& image, int step) {
    if (step < 1 || step > 1024) refuse("step", "1 to 1024", step);
    const ImageView view = step == 1 ? joined_rows(image) : image;
    const auto count = [&](int size) { return (std::max(size - step / 2, 0) + step - 1) / step; };
    const double samples = static_cast<double>(count(view.rows)) * count(view.cols);
    if (samples == 0.0) return Vector::Zero(3);
    Sums sums{0, 0, 0};
    BlockSums blocks(step);
    for (int y = step / 2; y < view.rows; y += step) {
        const std::uint8_t* row = view.row(y);
        if (step <= kMaxDenseStep) {
            blocks.add(row, view.cols, sums);
            continue;
        }
        for (int x = step / 2; x < view.cols; x += step)
            for (std::size_t c = 0; c < 3; ++c) sums[c] += row[3 * static_cast<std::size_t>(x) + c];
    }
    blocks.flush(sums);
    const double share = 1.0 / samples;
    Vector mean(3);
    for (std::size_t c = 0; c < 3; ++c)
        mean[static_cast<Eigen::Index>(c)] = static_cast<double>(sums[c]) * share;
    return mean;
}

}  // namespace tricue
