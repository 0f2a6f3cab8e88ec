// SPDX-License-Identifier: MIT
#include "camera/reduce_gray.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

/// The weights are 128 of `high` and one of `low`: both sums fit 16 bits, of which a register holds twice as many as of 32.
TRICUE_MULTIVERSION
void turn_gray(const std::uint8_t* __restrict pixels, std::ptrdiff_t n, std::uint8_t* __restrict gray) {
    for_overlapping_blocks<32>(n, [=](std::ptrdiff_t x) {
        const std::uint16_t b = pixels[3 * x], g = pixels[3 * x + 1], r = pixels[3 * x + 2];
        const auto high = static_cast<std::uint16_t>(29 * b + 150 * g + 76 * r);
        const auto low = static_cast<std::uint16_t>(23 * b + 35 * g + 70 * r);
        gray[x] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(high + (low >> 7) + 128) >> 8);
    });
}

TRICUE_MULTIVERSION
void add_row(const std::uint8_t* __restrict gray, std::ptrdiff_t n, std::uint32_t* __restrict sums) {
    for (std::ptrdiff_t x = 0; x < n; ++x) sums[x] += gray[x];
}

/// The means of cells, from the sums of their columns. kStep is the step, or 0 for any.
template <int kStep>
TRICUE_INLINE void average(const std::uint32_t* __restrict sums, std::ptrdiff_t cells, int any_step,
                           std::uint8_t* __restrict means) {
    const int step = kStep > 0 ? kStep : any_step;
    const float share = 1.0F / static_cast<float>(step * step);
    constexpr float kHalfToEven = 8388608.0F;  // above it floats are whole
    for (std::ptrdiff_t j = 0; j < cells; ++j) {
        std::uint32_t sum = 0;
        for (int k = 0; k < step; ++k) sum += sums[step * j + k];
        const float mean = static_cast<float>(static_cast<int>(sum)) * share;
        means[j] = kStep == 2
                       ? static_cast<std::uint8_t>((sum + 2) >> 2)
                       : static_cast<std::uint8_t>(static_cast<int>((mean + kHalfToEven) - kHalfToEven));
    }
}

TRICUE_MULTIVERSION
void average_cells(const std::uint32_t* sums, std::ptrdiff_t cells, int step, std::uint8_t* means) {
    switch (step) {
        case 2:
            return average<2>(sums, cells, step, means);
        case 3:
            return average<3>(sums, cells, step, means);
        case 4:
            return average<4>(sums, cells, step, means);
        default:
            return average<0>(sums, cells, step, means);
    }
}

}  // namespace

GrayImage reduce_gray(const ImageView& image, int step) {
    const int most = std::min(image.rows, image.cols);
    if (step < 1 || step > most) refuse("step", "1 to the image's smaller side", step);
    GrayImage cells(image.rows / step, image.cols / step);
    const std::ptrdiff_t cols = cells.cols() * step;
    const bool color = image.channels == 3;
    std::vector<std::uint8_t> gray(color && step > 1 ? static_cast<std::size_t>(cols) : 0);
    std::vector<std::uint32_t> sums(step > 1 ? static_cast<std::size_t>(cols) : 0);
    for (int i = 0; i < cells.rows(); ++i) {
        std::uint8_t* out = cells.data() + i * cells.cols();
        if (step == 1) {
            if (color)
                turn_gray(image.row(i), cols, out);
            else
                std::memcpy(out, image.row(i), static_cast<std::size_t>(cols));
            continue;
        }
        std::fill(sums.begin(), sums.end(), 0U);
        for (int y = i * step; y < (i + 1) * step; ++y) {
            if (color) turn_gray(image.row(y), cols, gray.data());
            add_row(color ? gray.data() : image.row(y), cols, sums.data());
        }
        average_cells(sums.data(), cells.cols(), step, out);
    }
    return cells;
}

}  // namespace tricue
