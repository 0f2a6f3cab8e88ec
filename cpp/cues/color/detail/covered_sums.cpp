// SPDX-License-Identifier: MIT
#include "cues/color/detail/covered_sums.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kTogether = 8;

/// Running sums along some rows at once, for each waits for its last. They have one number more than the row, first 0.
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

CoveredPlace place_of(double at, int size) {
    const double inside = std::min(std::max(at, 0.0), static_cast<double>(size));
    const int whole = std::min(static_cast<int>(inside), size - 1);
    return {whole, inside - whole};
}

/// Of running sums: a row's and the next one's of both places.
TRICUE_MULTIVERSION
void between(const double* low, const double* low_next, double low_part, const double* high,
             const double* high_next, double high_part, int n, double* __restrict strip) {
    for (int x = 0; x < n; ++x) {
        const double upto_high = high[x] + high_part * (high_next[x] - high[x]);
        const double upto_low = low[x] + low_part * (low_next[x] - low[x]);
        strip[x] = upto_high - upto_low;
    }
}

}  // namespace

CoveredSums::CoveredSums(const PlaneView& plane)
    : rows_(plane.rows),
      cols_(plane.cols),
      sums_((static_cast<std::size_t>(rows_) + 1) * (static_cast<std::size_t>(cols_) + 1)),
      strip_(static_cast<std::size_t>(cols_) + 1) {
    int y = 0;
    for (; y + kTogether <= rows_; y += kTogether)
        sum_along<kTogether>(plane.row(y), plane.stride, cols_, row(y + 1));
    for (; y < rows_; ++y) sum_along<1>(plane.row(y), plane.stride, cols_, row(y + 1));
    for (y = 0; y < rows_; ++y) add_row(row(y), cols_ + 1, row(y + 1));
    for (int x = 0; x <= cols_; ++x)
        if (!std::isfinite(row(rows_)[x])) refuse("plane", "finite numbers", row(rows_)[x]);
}

void CoveredSums::take_rows(double low, double high) {
    const CoveredPlace from = place_of(low, rows_), to = place_of(high, rows_);
    between(row(from.whole), row(from.whole + 1), from.part, row(to.whole), row(to.whole + 1), to.part,
            cols_ + 1, strip_.data());
}

CoveredSpan CoveredSums::across(double low, double high) const {
    return {place_of(low, cols_), place_of(high, cols_)};
}

}  // namespace tricue
