// SPDX-License-Identifier: MIT
#include "base/gray_cells.hpp"

#include <cmath>
#include <cstddef>

#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kMaxNarrowStep = 257;  ///< largest step with which the sum of a cell's column fits 16 bits
constexpr int kRowsAhead = 6;        ///< whose pixels are loaded while a row is converted to gray

/// The weights are 128 `high` + `low`: both sums fit 16 bits, and a register holds twice as many 16-bit as 32-bit numbers.
TRICUE_MULTIVERSION
void turn_gray(const std::uint8_t* __restrict pixels, std::ptrdiff_t n, std::uint8_t* __restrict gray) {
    const auto turn = [=](std::ptrdiff_t x) {
        const std::uint16_t b = pixels[3 * x], g = pixels[3 * x + 1], r = pixels[3 * x + 2];
        const auto high = static_cast<std::uint16_t>(29 * b + 150 * g + 76 * r);
        const auto low = static_cast<std::uint16_t>(23 * b + 35 * g + 70 * r);
        gray[x] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(high + (low >> 7) + 128) >> 8);
    };
    if (n < 64)
        for_overlapping_blocks<32>(n, turn);
    else
        for_overlapping_blocks<64>(n, turn);
}

/// Converts as many rows as a cell has to gray levels.
struct Levels {
    const std::uint8_t* data;
    std::ptrdiff_t stride;
    int step;
};

/// kStep is the step, or 0 for any step.
template <int kStep>
TRICUE_INLINE void average(const Levels& levels, std::ptrdiff_t cells, std::uint16_t* __restrict sums,
                           std::uint8_t* __restrict means) {
    const int step = kStep > 0 ? kStep : levels.step;
    const std::ptrdiff_t stride = levels.stride;
    const std::uint8_t* __restrict data = levels.data;
    for_overlapping_blocks<32>(cells * step, [=](std::ptrdiff_t x) {
        std::uint16_t sum = data[x];
        for (int k = 1; k < step; ++k) sum = static_cast<std::uint16_t>(sum + data[k * stride + x]);
        sums[x] = sum;
    });
    const float share = 1.0F / static_cast<float>(step * step);
    constexpr float kHalfToEven = 8388608.0F;  // above this, floats are whole numbers
    for_overlapping_blocks<16>(cells, [=](std::ptrdiff_t j) {
        int sum = 0;
        for (int k = 0; k < step; ++k) sum += sums[step * j + k];
        const float mean = static_cast<float>(sum) * share;
        means[j] = kStep == 2
                       ? static_cast<std::uint8_t>((sum + 2) >> 2)
                       : static_cast<std::uint8_t>(static_cast<int>((mean + kHalfToEven) - kHalfToEven));
    });
}

/// The means of cells; `sums` has room for the sums of their columns, which fit 16 bits up to a step of 257.
TRICUE_MULTIVERSION
void average_cells(const Levels& levels, std::ptrdiff_t cells, std::uint16_t* sums, std::uint8_t* means) {
    switch (levels.step) {
        case 2:
            return average<2>(levels, cells, sums, means);
        case 3:
            return average<3>(levels, cells, sums, means);
        case 4:
            return average<4>(levels, cells, sums, means);
        default:
            return average<0>(levels, cells, sums, means);
    }
}

/// The same for larger steps, for which speed doesn't matter.
void average_wide_cells(const Levels& levels, std::ptrdiff_t cells, std::uint8_t* means) {
    const std::ptrdiff_t step = levels.step;
    for (std::ptrdiff_t j = 0; j < cells; ++j) {
        double sum = 0.0;
        for (std::ptrdiff_t k = 0; k < step; ++k)
            for (std::ptrdiff_t i = 0; i < step; ++i) sum += levels.data[k * levels.stride + j * step + i];
        means[j] = static_cast<std::uint8_t>(
            std::nearbyint(static_cast<float>(sum) * (1.0F / static_cast<float>(step * step))));
    }
}

}  // namespace

GrayCells::GrayCells(const ImageView& image, int step) : image_(image), step_(step) {}

const std::uint8_t* GrayCells::row(int y, int x0, int x1, std::uint8_t* room) {
    const bool color = image_.channels == 3;
    const std::ptrdiff_t begin = std::ptrdiff_t{x0} * step_ * image_.channels, cells = x1 - x0,
                         n = cells * step_;
    Levels levels{image_.row(y * step_) + begin, image_.stride, step_};
    if (step_ == 1 && !color) return levels.data;

    if (color && step_ > 1) gray_.resize(static_cast<std::size_t>(n * step_));
    std::uint8_t* gray = step_ > 1 ? gray_.data() : room;
    for (int row = y * step_; row < (y + 1) * step_; ++row) {
        if (row + kRowsAhead < image_.rows)
            prefetch_bytes(image_.row(row + kRowsAhead) + begin, n * image_.channels);
        if (color) turn_gray(image_.row(row) + begin, n, gray + (row - y * step_) * n);
    }
    if (step_ == 1) return room;
    if (color) levels = {gray, n, step_};
    if (step_ > kMaxNarrowStep) {
        average_wide_cells(levels, cells, room);
        return room;
    }
    sums_.resize(static_cast<std::size_t>(n));
    average_cells(levels, cells, sums_.data(), room);
    return room;
}

}  // namespace tricue
