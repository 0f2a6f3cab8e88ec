// SPDX-License-Identifier: MIT
#include "covered_sums.hpp"

#include <algorithm>
#include <cmath>

#include "check.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void add_row(const double* __restrict before, const float* __restrict row, int n, double* __restrict sums) {
    for (int x = 0; x < n; ++x) sums[x] = before[x] + row[x];
}

/// A place between rows or columns: the one that it lies in, which the last one's end belongs to, and how far.
struct Place {
    int whole;
    double part;
};

Place place_of(double at, int size) {
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
      down_((static_cast<std::size_t>(rows_) + 1) * static_cast<std::size_t>(cols_)),
      across_(static_cast<std::size_t>(cols_) + 1) {
    for (int y = 0; y < rows_; ++y)
        add_row(row(y), plane.row(y), cols_, down_.data() + (std::ptrdiff_t{y} + 1) * cols_);
    for (int x = 0; x < cols_; ++x)
        if (!std::isfinite(row(rows_)[x])) refuse("plane", "finite numbers", row(rows_)[x]);
}

void CoveredSums::take_rows(double low, double high) {
    const Place from = place_of(low, rows_), to = place_of(high, rows_);
    double* strip = across_.data() + 1;
    between(row(from.whole), row(from.whole + 1), from.part, row(to.whole), row(to.whole + 1), to.part, cols_,
            strip);
    for (int x = 1; x < cols_; ++x) strip[x] += strip[x - 1];
}

double CoveredSums::upto(double x) const {
    const Place at = place_of(x, cols_);
    const double* sums = across_.data() + at.whole;
    return sums[0] + at.part * (sums[1] - sums[0]);
}

}  // namespace tricue
