// SPDX-License-Identifier: MIT
#include "cues/color/sample_windows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "check.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

constexpr int kUnit = 64;         // parts of a pixel that places are rounded to
constexpr int kMostReadings = 4;  // of a sample along one axis
constexpr int kMostPixels = 2 * kMostReadings;
constexpr int kLanes = 4;  // blue, green, red, and one that is thrown away

using Four [[gnu::vector_size(4 * kLanes)]] = float;

/// Which pixels a sample has along one axis, and how much of each, in parts of kUnit.
struct Sample {
    int pixels[kMostPixels];
    float weights[kMostPixels];  // whole numbers, 0 beyond the last pixel

    void add(int pixel, int weight, int* count) {
        if (*count == 0 || pixels[*count - 1] != pixel) pixels[(*count)++] = pixel;
        weights[*count - 1] += static_cast<float>(weight);
    }
};

struct Axis {
    std::vector<Sample> samples;
    int readings;    ///< of each sample
    int pixels = 0;  ///< that each sample has at most, rounded up to pairs

    int first() const { return samples.front().pixels[0]; }
    int last() const { return *std::max_element(samples.back().pixels, samples.back().pixels + kMostPixels); }
};

Axis find_samples(double start, double length, int count, int size) {
    const double step = length / count;
    Axis axis{std::vector<Sample>(static_cast<std::size_t>(count)),
              static_cast<int>(std::min(std::max(std::ceil(step), 1.0), double{kMostReadings}))};
    const int readings = axis.readings;
    const double apart = step / readings, most = size - 1.0;
    int reading = 0;
    for (Sample& sample : axis.samples) {
        int used = 0;
        for (int j = 0; j < readings; ++j, ++reading) {
            const double place = start + (reading + 0.5) * apart - 0.5;
            const double inside = std::min(std::max(place, 0.0), most);
            const int fixed = static_cast<int>(inside * kUnit + 0.5), low = fixed / kUnit;
            sample.add(low, kUnit - fixed % kUnit, &used);
            sample.add(std::min(low + 1, size - 1), fixed % kUnit, &used);
        }
        std::fill(sample.pixels + used, sample.pixels + kMostPixels, sample.pixels[0]);
        axis.pixels = std::max(axis.pixels, used + used % 2);
    }
    return axis;
}

/// Rows of bytes and how much of each is in a blend of them.
struct Rows {
    const std::uint8_t* bytes[kMostPixels];
    std::uint16_t shares[kMostPixels];
};

/// A sum is at most 255 times that of the shares, 4 kUnit, so 16 bits hold it.
template <int kRows>
inline void blend_all(const Rows& rows, int n, float* blend) {
    const Rows own = rows;
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        std::uint16_t sum = 0;
        for (int k = 0; k < kRows; ++k)
            sum = static_cast<std::uint16_t>(sum + own.bytes[k][x] * own.shares[k]);
        blend[x] = sum;
    }
}

TRICUE_MULTIVERSION
void blend_rows(const Rows& rows, int count, int n, float* blend) {
    if (count == 2)
        blend_all<2>(rows, n, blend);
    else if (count == 4)
        blend_all<4>(rows, n, blend);
    else if (count == 6)
        blend_all<6>(rows, n, blend);
    else
        blend_all<kMostPixels>(rows, n, blend);
}

/// `blend` begins at the first pixel and has a number more than its pixels, `sums` one more than 3 a sample.
TRICUE_MULTIVERSION
void add_columns(const Sample* samples, int count, int pixels, const float* blend, float* sums) {
    for (int i = 0; i < count; ++i) {
        Four sum = {0, 0, 0, 0};
        for (int k = 0; k < pixels; ++k) {
            Four color;
            __builtin_memcpy(&color, blend + samples[i].pixels[k], sizeof color);
            sum += color * samples[i].weights[k];
        }
        __builtin_memcpy(sums + 3 * i, &sum, sizeof sum);
    }
}

/// Quotients are no nearer than 1 / (12 kUnit²) to a half that they aren't, further than both roundings go.
TRICUE_MULTIVERSION
void divide(const float* __restrict sums, float whole, int n, std::uint8_t* __restrict bytes) {
    for (int x = 0; x < n; ++x)
        bytes[x] = static_cast<std::uint8_t>(static_cast<int>(sums[x] / whole + 0.5F));
}

void sample_window(const ImageView& image, const Axis& down, Axis across, std::uint8_t* bytes) {
    const int left = across.first(), width = 3 * (across.last() + 1 - left);
    auto& columns = across.samples;
    const int count = static_cast<int>(columns.size());
    for (Sample& column : columns)
        for (int& pixel : column.pixels) pixel = 3 * (pixel - left);  // where in a row of numbers
    std::vector<float> blend(static_cast<std::size_t>(width) + 1), row(3 * columns.size() + 1);
    const auto whole = static_cast<float>(down.readings * across.readings * kUnit * kUnit);
    for (const Sample& sample : down.samples) {
        Rows rows;
        for (int k = 0; k < kMostPixels; ++k) {
            rows.bytes[k] = image.row(sample.pixels[k]) + 3 * left;
            rows.shares[k] = static_cast<std::uint16_t>(sample.weights[k]);
        }
        blend_rows(rows, down.pixels, width, blend.data());
        add_columns(columns.data(), count, across.pixels, blend.data(), row.data());
        divide(row.data(), whole, 3 * count, bytes);
        bytes += 3 * count;
    }
}

void require_arguments(const ImageView& image, StatesRef windows, int rows, int columns) {
    if (image.rows < 1 || image.cols < 1) refuse("image", "at least one pixel", "none");
    require_shape(windows, windows.rows(), 4, "windows");
    require_finite(windows, "windows");
    for (Eigen::Index i = 0; i < windows.rows(); ++i)
        for (const double size : {windows(i, 2), windows(i, 3)})
            if (!(size > 0.0)) refuse("windows", "widths and heights above 0", size);
    if (rows < 1) refuse("rows", "at least 1", rows);
    if (columns < 1) refuse("columns", "at least 1", columns);
}

}  // namespace

WindowBytes sample_windows(const ImageView& image, StatesRef windows, int rows, int columns) {
    require_arguments(image, windows, rows, columns);
    const Eigen::Index each = Eigen::Index{3} * rows * columns;
    WindowBytes samples(windows.rows() * each);
    for (Eigen::Index i = 0; i < windows.rows(); ++i) {
        Axis across = find_samples(windows(i, 0), windows(i, 2), columns, image.cols);
        const Axis down = find_samples(windows(i, 1), windows(i, 3), rows, image.rows);
        sample_window(image, down, std::move(across), samples.data() + i * each);
    }
    return samples;
}

}  // namespace tricue
