// SPDX-License-Identifier: MIT
#include "cues/color/detail/integral_image.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kRowsAtOnce = 8;

/// Running sums along kRows rows at once, since each sum waits for the previous one. They begin with an additional 0.
template <unsigned kRows>
void sum_along(const float* rows, std::ptrdiff_t stride, int n, double* sums) {
    double sum[std::size_t{kRows}] = {};
    for (int x = 0; x < n; ++x)
        for (std::ptrdiff_t k = 0; k < kRows; ++k) {
            sum[k] += rows[k * stride + x];
            sums[k * (std::ptrdiff_t{n} + 1) + x + 1] = sum[k];
        }
}

TRICUE_MULTIVERSION
void add_row(const double* __restrict above, int n, double* __restrict sums) {
    for (int x = 0; x < n; ++x) sums[x] += above[x];
}

FractionalIndex split_index(double at, int size) {
    const double inside = std::min(std::max(0.0, at), static_cast<double>(size));
    const int index = std::min(static_cast<int>(inside), size - 1);
    return {index, inside - index};
}

/// The difference of the integral image at two heights, each interpolated between a row and the next.
TRICUE_MULTIVERSION
void interpolate_band(const double* low, const double* low_next, double low_fraction, const double* high,
                      const double* high_next, double high_fraction, int n, double* __restrict band) {
    for (int x = 0; x < n; ++x) {
        const double up_to_high = high[x] + high_fraction * (high_next[x] - high[x]);
        const double up_to_low = low[x] + low_fraction * (low_next[x] - low[x]);
        band[x] = up_to_high - up_to_low;
    }
}

/// Throws, naming the first number that isn't finite; there must be one.
[[noreturn]] void refuse_strange(const PlaneView& plane) {
    int y = 0;
    const auto is_finite = [](float number) { return std::isfinite(number); };
    while (std::all_of(plane.row(y), plane.row(y) + plane.cols, is_finite)) ++y;
    refuse("plane", "finite numbers", *std::find_if_not(plane.row(y), plane.row(y) + plane.cols, is_finite));
}

}  // namespace

IntegralImage::IntegralImage(const PlaneView& plane)
    : rows_(plane.rows),
      cols_(plane.cols),
      sums_((static_cast<std::size_t>(rows_) + 1) * (static_cast<std::size_t>(cols_) + 1)),
      band_(static_cast<std::size_t>(cols_) + 1) {
    int y = 0;
    for (; y + kRowsAtOnce <= rows_; y += kRowsAtOnce)
        sum_along<kRowsAtOnce>(plane.row(y), plane.stride, cols_, row(y + 1));
    for (; y < rows_; ++y) sum_along<1>(plane.row(y), plane.stride, cols_, row(y + 1));
    for (y = 0; y < rows_; ++y) add_row(row(y), cols_ + 1, row(y + 1));
    for (int x = 0; x <= cols_; ++x)
        if (!std::isfinite(row(rows_)[x])) refuse_strange(plane);
}

void IntegralImage::select_rows(double low, double high) {
    const FractionalIndex from = split_index(low, rows_), to = split_index(high, rows_);
    interpolate_band(row(from.index), row(from.index + 1), from.fraction, row(to.index), row(to.index + 1),
                     to.fraction, cols_ + 1, band_.data());
}

ColumnSpan IntegralImage::column_span(double low, double high) const {
    return {split_index(low, cols_), split_index(high, cols_)};
}

}  // namespace tricue
