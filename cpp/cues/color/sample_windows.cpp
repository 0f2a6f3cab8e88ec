// SPDX-License-Identifier: MIT
#include "cues/color/sample_windows.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kSubpixels = 64;   // positions are rounded to 1 / kSubpixels of a pixel
constexpr int kMaxReadings = 4;  // of a sample along one axis
constexpr int kMaxRows = 2 * kMaxReadings;
constexpr int kPrefetchSamples = 2;  // rows of samples that are loaded ahead
constexpr int kBlock = 64;           // numbers of a row that are blended at once
constexpr int kLanes = 8;            // numbers of two neighboring pixels, and two unused ones

using TwoPixels = Pack<float, kLanes>;

/// A position along one axis, fraction / kSubpixels of the way from a pixel to the next.
struct Reading {
    int pixel, fraction;
};

/// `count` samples with as many readings each.
struct Axis {
    int count, each;
    std::vector<Reading> readings;

    int first() const { return readings.front().pixel; }
    int last() const { return readings.back().pixel; }
};

Axis find_readings(double start, double length, int count, int size) {
    const double step = length / count;
    const int each = static_cast<int>(std::min(std::max(std::ceil(step), 1.0), double{kMaxReadings}));
    Axis axis{count, each, std::vector<Reading>(static_cast<std::size_t>(count * each))};
    const double apart = step / each, most = size - 1.0;
    for (int i = 0; i < count * each; ++i) {
        const double place = start + (i + 0.5) * apart - 0.5;
        const double inside = std::min(std::max(0.0, place), most);
        const int fixed = static_cast<int>(inside * kSubpixels + 0.5);
        axis.readings[static_cast<std::size_t>(i)] = {fixed / kSubpixels, fixed % kSubpixels};
    }
    return axis;
}

/// Rows of bytes and their weights in a blend, 0 beyond `count`.
struct Rows {
    const std::uint8_t* bytes[kMaxRows];
    std::uint16_t shares[kMaxRows] = {};
    int count = 0;

    void add(const std::uint8_t* row, int share) {
        if (share == 0) return;
        if (count == 0 || bytes[count - 1] != row) bytes[count++] = row;
        shares[count - 1] = static_cast<std::uint16_t>(shares[count - 1] + share);
    }
};

/// The offset of a reading's two pixels in a row of numbers, and the weight of each number of BGR pixels.
struct Column {
    int at;
    float weights[kLanes];
};

/// Numbers from `begin` to `end`. A sum is at most 255 times that of the shares, 4 kSubpixels, so 16 bits hold it.
template <int kRows>
inline void blend_range(const Rows& rows, int begin, int end, float* blend) {
    const Rows own = rows;
    TRICUE_INDEPENDENT
    for (int x = begin; x < end; ++x) {
        std::uint16_t sum = 0;
        for (int k = 0; k < kRows; ++k)
            sum = static_cast<std::uint16_t>(sum + own.bytes[k][x] * own.shares[k]);
        blend[x] = sum;
    }
}

/// The remainder is a last block that overlaps the previous one, instead of single numbers.
template <int kRows>
inline void blend_all(const Rows& rows, int n, float* blend) {
    const int whole = n / kBlock * kBlock;
    blend_range<kRows>(rows, 0, whole, blend);
    if (whole < n) blend_range<kRows>(rows, std::max(n - kBlock, 0), n, blend);
}

TRICUE_MULTIVERSION
void blend_rows(const Rows& rows, int n, float* blend) {
    if (rows.count <= 2)
        blend_all<2>(rows, n, blend);
    else if (rows.count <= 4)
        blend_all<4>(rows, n, blend);
    else if (rows.count <= 6)
        blend_all<6>(rows, n, blend);
    else
        blend_all<kMaxRows>(rows, n, blend);
}

/// Samples of kEach columns. `sums` has room for 3 numbers per sample and kLanes - 3 more.
template <int kEach>
inline void sum_samples(const Column* columns, int count, const float* blend, float* sums) {
    for (int i = 0; i < count; ++i, columns += kEach, sums += 3) {
        TwoPixels sum = {};
        for (int j = 0; j < kEach; ++j) {
            TwoPixels colors, weights;
            load(blend + columns[j].at, colors);
            load(columns[j].weights, weights);
            sum += colors * weights;
        }
        TwoPixels next;
        permute<3, 4, 5, 3, 3, 3, 3, 3>(sum, next);
        sum += next;
        store(sum, sums);
    }
}

/// The same for gray pixels: the first number is one pixel's, the next the other's.
TRICUE_MULTIVERSION
void sum_gray_columns(const Column* columns, int count, int each, const float* blend, float* sums) {
    for (int i = 0; i < count; ++i) {
        float sum = 0.0F;
        for (int j = 0; j < each; ++j, ++columns) {
            const float* pixels = blend + columns->at;
            sum += pixels[0] * columns->weights[0] + pixels[1] * columns->weights[3];
        }
        sums[i] = sum;
    }
}

TRICUE_MULTIVERSION
void sum_columns(const Column* columns, int count, int each, const float* blend, float* sums) {
    if (each == 1)
        sum_samples<1>(columns, count, blend, sums);
    else if (each == 2)
        sum_samples<2>(columns, count, blend, sums);
    else if (each == 3)
        sum_samples<3>(columns, count, blend, sums);
    else
        sum_samples<kMaxReadings>(columns, count, blend, sums);
}

/// A quotient is exactly a half or at least 1 / (12 kSubpixels²) away from it, which is more than both rounding errors.
TRICUE_MULTIVERSION
void divide(const float* __restrict sums, float whole, int n, std::uint8_t* __restrict bytes) {
    for (int x = 0; x < n; ++x)
        bytes[x] = static_cast<std::uint8_t>(static_cast<int>(sums[x] / whole + 0.5F));
}

Rows find_rows(const ImageView& image, const Axis& down, int sample, int left) {
    Rows rows;
    const Reading* reading = down.readings.data() + std::ptrdiff_t{sample} * down.each;
    for (int j = 0; j < down.each; ++j) {
        const auto [pixel, fraction] = reading[j];
        rows.add(image.row(pixel) + image.channels * left, kSubpixels - fraction);
        rows.add(image.row(std::min(pixel + 1, image.rows - 1)) + image.channels * left, fraction);
    }
    std::fill(rows.bytes + rows.count, rows.bytes + kMaxRows, rows.bytes[0]);
    return rows;
}

/// Begins to load the rows of a sample, if there is one.
void prefetch_rows(const ImageView& image, const Axis& down, int sample, int left, int width) {
    if (sample >= down.count) return;
    const Reading* reading = down.readings.data() + std::ptrdiff_t{sample} * down.each;
    int before = -1;
    for (int j = 0; j < down.each; ++j)
        for (const int row : {reading[j].pixel, std::min(reading[j].pixel + 1, image.rows - 1)}) {
            if (row > before) prefetch_bytes(image.row(row) + image.channels * left, width);
            before = row;
        }
}

std::vector<Column> find_columns(const Axis& across, int channels) {
    std::vector<Column> columns;
    columns.reserve(across.readings.size());
    for (const auto [pixel, fraction] : across.readings) {
        const auto next = static_cast<float>(fraction), own = static_cast<float>(kSubpixels - fraction);
        columns.push_back({channels * (pixel - across.first()), {own, own, own, next, next, next, 0, 0}});
    }
    return columns;
}

void sample_window(const ImageView& image, const Axis& down, const Axis& across, std::uint8_t* bytes) {
    const int left = across.first(), channels = image.channels, numbers = channels * across.count;
    const int width = channels * (std::min(across.last() + 2, image.cols) - left);
    const std::vector<Column> columns = find_columns(across, channels);
    std::vector<float> blend(static_cast<std::size_t>(width + kLanes)),
        sums(static_cast<std::size_t>(numbers + kLanes));
    const auto whole = static_cast<float>(down.each * across.each * kSubpixels * kSubpixels);
    for (int y = 0; y < down.count; ++y, bytes += numbers) {
        prefetch_rows(image, down, y + kPrefetchSamples, left, width);
        blend_rows(find_rows(image, down, y, left), width, blend.data());
        (channels == 1 ? sum_gray_columns : sum_columns)(columns.data(), across.count, across.each,
                                                         blend.data(), sums.data());
        divide(sums.data(), whole, numbers, bytes);
    }
}

void require_arguments(const ImageView& image, StatesRef windows, int rows, int columns) {
    if (image.rows < 1 || image.cols < 1) refuse("image", "at least one pixel", "none");
    require_shape(windows, windows.rows(), 4, "windows");
    require_finite(windows, "windows");
    for (Eigen::Index i = 0; i < windows.rows(); ++i)
        for (const double size : {windows(i, 2), windows(i, 3)})
            if (!(size > 0.0)) refuse("windows", "widths and heights above 0", size);
    require_count(rows, 1, kMaxImageSide, "rows");
    require_count(columns, 1, kMaxImageSide, "columns");
}

}  // namespace

WindowBytes sample_windows(const ImageView& image, StatesRef windows, int rows, int columns) {
    require_arguments(image, windows, rows, columns);
    const Eigen::Index each = Eigen::Index{image.channels} * rows * columns;
    WindowBytes samples(windows.rows() * each);
    for (Eigen::Index i = 0; i < windows.rows(); ++i) {
        const Axis across = find_readings(windows(i, 0), windows(i, 2), columns, image.cols);
        const Axis down = find_readings(windows(i, 1), windows(i, 3), rows, image.rows);
        sample_window(image, down, across, samples.data() + i * each);
    }
    return samples;
}

}  // namespace tricue
