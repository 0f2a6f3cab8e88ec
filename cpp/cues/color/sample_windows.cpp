// SPDX-License-Identifier: MIT
#include "cues/color/sample_windows.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kUnit = 64;         // parts of a pixel that places are rounded to
constexpr int kMostReadings = 4;  // of a sample along one axis
constexpr int kMostPixels = 2 * kMostReadings;
constexpr int kBlock = 64;  // numbers of a row that are blended at once
constexpr int kLanes = 8;   // numbers of two neighbouring pixels, and two that are thrown away

using Eight = Pack<float, kLanes>;

/// A place along one axis, between a pixel and the next, in parts of kUnit from the first.
struct Reading {
    int pixel, past;
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
    const int each = static_cast<int>(std::min(std::max(std::ceil(step), 1.0), double{kMostReadings}));
    Axis axis{count, each, std::vector<Reading>(static_cast<std::size_t>(count * each))};
    const double apart = step / each, most = size - 1.0;
    for (int i = 0; i < count * each; ++i) {
        const double place = start + (i + 0.5) * apart - 0.5;
        const double inside = std::min(std::max(place, 0.0), most);
        const int fixed = static_cast<int>(inside * kUnit + 0.5);
        axis.readings[static_cast<std::size_t>(i)] = {fixed / kUnit, fixed % kUnit};
    }
    return axis;
}

/// Rows of bytes and how much of each is in a blend of them, none beyond `count`.
struct Rows {
    const std::uint8_t* bytes[kMostPixels];
    std::uint16_t shares[kMostPixels] = {};
    int count = 0;

    void add(const std::uint8_t* row, int share) {
        if (share == 0) return;
        if (count == 0 || bytes[count - 1] != row) bytes[count++] = row;
        shares[count - 1] = static_cast<std::uint16_t>(shares[count - 1] + share);
    }
};

/// Where in a row of numbers a reading's two pixels begin, and how much of each number is in it.
struct Column {
    int at;
    float weights[kLanes];
};

/// Numbers from `begin` to `end`. A sum is at most 255 times that of the shares, 4 kUnit, so 16 bits hold it.
template <int kRows>
inline void blend_part(const Rows& rows, int begin, int end, float* blend) {
    const Rows own = rows;
    TRICUE_INDEPENDENT
    for (int x = begin; x < end; ++x) {
        std::uint16_t sum = 0;
        for (int k = 0; k < kRows; ++k)
            sum = static_cast<std::uint16_t>(sum + own.bytes[k][x] * own.shares[k]);
        blend[x] = sum;
    }
}

/// What whole registers leave over would be done one by one: it is done by a last block that reaches back.
template <int kRows>
inline void blend_all(const Rows& rows, int n, float* blend) {
    const int whole = n / kBlock * kBlock;
    blend_part<kRows>(rows, 0, whole, blend);
    if (whole < n) blend_part<kRows>(rows, std::max(n - kBlock, 0), n, blend);
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
        blend_all<kMostPixels>(rows, n, blend);
}

/// Samples of kEach columns. `sums` has kLanes - 3 numbers more than 3 a sample.
template <int kEach>
inline void add_all(const Column* columns, int count, const float* blend, float* sums) {
    for (int i = 0; i < count; ++i, columns += kEach, sums += 3) {
        Eight sum = {};
        for (int j = 0; j < kEach; ++j) {
            Eight colors, weights;
            load(blend + columns[j].at, colors);
            load(columns[j].weights, weights);
            sum += colors * weights;
        }
        Eight next;
        permute<3, 4, 5, 3, 3, 3, 3, 3>(sum, next);
        sum += next;
        store(sum, sums);
    }
}

TRICUE_MULTIVERSION
void add_columns(const Column* columns, int count, int each, const float* blend, float* sums) {
    if (each == 1)
        add_all<1>(columns, count, blend, sums);
    else if (each == 2)
        add_all<2>(columns, count, blend, sums);
    else if (each == 3)
        add_all<3>(columns, count, blend, sums);
    else
        add_all<kMostReadings>(columns, count, blend, sums);
}

/// Quotients are no nearer than 1 / (12 kUnit²) to a half that they aren't, further than both roundings go.
TRICUE_MULTIVERSION
void divide(const float* __restrict sums, float whole, int n, std::uint8_t* __restrict bytes) {
    for (int x = 0; x < n; ++x)
        bytes[x] = static_cast<std::uint8_t>(static_cast<int>(sums[x] / whole + 0.5F));
}

Rows rows_of(const ImageView& image, const Axis& down, int sample, int left) {
    Rows rows;
    const Reading* reading = down.readings.data() + std::ptrdiff_t{sample} * down.each;
    for (int j = 0; j < down.each; ++j) {
        const auto [pixel, past] = reading[j];
        rows.add(image.row(pixel) + 3 * left, kUnit - past);
        rows.add(image.row(std::min(pixel + 1, image.rows - 1)) + 3 * left, past);
    }
    std::fill(rows.bytes + rows.count, rows.bytes + kMostPixels, rows.bytes[0]);
    return rows;
}

std::vector<Column> columns_of(const Axis& across) {
    std::vector<Column> columns;
    columns.reserve(across.readings.size());
    for (const auto [pixel, past] : across.readings) {
        const auto next = static_cast<float>(past), own = static_cast<float>(kUnit - past);
        columns.push_back({3 * (pixel - across.first()), {own, own, own, next, next, next, 0, 0}});
    }
    return columns;
}

void sample_window(const ImageView& image, const Axis& down, const Axis& across, std::uint8_t* bytes) {
    const int left = across.first(), numbers = 3 * across.count;
    const int width = 3 * (std::min(across.last() + 2, image.cols) - left);
    const std::vector<Column> columns = columns_of(across);
    std::vector<float> blend(static_cast<std::size_t>(width + kLanes)),
        sums(static_cast<std::size_t>(numbers + kLanes));
    const auto whole = static_cast<float>(down.each * across.each * kUnit * kUnit);
    for (int y = 0; y < down.count; ++y, bytes += numbers) {
        blend_rows(rows_of(image, down, y, left), width, blend.data());
        add_columns(columns.data(), across.count, across.each, blend.data(), sums.data());
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
    if (rows < 1) refuse("rows", "at least 1", rows);
    if (columns < 1) refuse("columns", "at least 1", columns);
}

}  // namespace

WindowBytes sample_windows(const ImageView& image, StatesRef windows, int rows, int columns) {
    require_arguments(image, windows, rows, columns);
    const Eigen::Index each = Eigen::Index{3} * rows * columns;
    WindowBytes samples(windows.rows() * each);
    for (Eigen::Index i = 0; i < windows.rows(); ++i) {
        const Axis across = find_readings(windows(i, 0), windows(i, 2), columns, image.cols);
        const Axis down = find_readings(windows(i, 1), windows(i, 3), rows, image.rows);
        sample_window(image, down, across, samples.data() + i * each);
    }
    return samples;
}

}  // namespace tricue
