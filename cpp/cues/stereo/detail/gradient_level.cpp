// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/gradient_level.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/simd.hpp"
#include "cues/stereo/detail/box_filter.hpp"

namespace tricue {
namespace {

constexpr int kTaps = 4;  // of f_R: the columns that x - d lies between, and one more on each side

/// Copies all taps of a pixel at once: several times faster than a gather for each tap.
void gather(const float* f, const int* column, int n, float* taps) {
    for (int x = 0; x < n; ++x) std::memcpy(taps + kTaps * x, f + column[x] - 1, kTaps * sizeof(float));
}

/// f_R and f_x^R between columns.
TRICUE_MULTIVERSION
void interpolate(const float* __restrict taps, const float* __restrict share, int n, float* __restrict right,
                 float* __restrict slope) {
    for (int x = 0; x < n; ++x) {
        const float before = taps[kTaps * x], at = taps[kTaps * x + 1], after = taps[kTaps * x + 2],
                    beyond = taps[kTaps * x + 3];
        const float first = after - before, second = beyond - at;  // twice the slopes of both columns
        right[x] = at + share[x] * (after - at);
        slope[x] = 0.5F * (first + share[x] * (second - first));
    }
}

/// The terms of equation (7), a row of each: f_L, f_R, f_x^R, and the expected disparities.
struct Equations {
    const float *left, *right, *right_slope, *visible, *offset;
};

struct Products {
    float *ss, *st, *tt, *power, *reliability;
};

/// No row overlaps another: GCC ignores __restrict of pointers in a struct.
TRICUE_MULTIVERSION
void multiply(const Equations& row, int n, const Products& out) {
    const Equations in = row;
    const Products to = out;
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        const float left_slope = 0.5F * (in.left[x + 1] - in.left[x - 1]), visible = in.visible[x];
        const float s = 0.5F * visible * (in.right_slope[x] + left_slope);
        to.ss[x] = s * s;
        to.st[x] = s * (s * in.offset[x] + visible * (in.right[x] - in.left[x]));
    }
}

TRICUE_MULTIVERSION
void multiply_finest(const Equations& row, int n, const Products& out) {
    const Equations in = row;
    const Products to = out;
    TRICUE_INDEPENDENT
    for (int x = 0; x < n; ++x) {
        const float left = in.left[x], right = in.right[x], right_slope = in.right_slope[x];
        const float left_slope = 0.5F * (in.left[x + 1] - in.left[x - 1]), visible = in.visible[x];
        const float s = 0.5F * visible * (right_slope + left_slope);
        const float t = s * in.offset[x] + visible * (right - left);
        to.ss[x] = s * s;
        to.st[x] = s * t;
        to.tt[x] = t * t;
        to.power[x] = visible * (left * left + right * right);
        to.reliability[x] = visible * (left_slope * left_slope + right_slope * right_slope);
    }
}

Region expanded(const Region& region, int across, int down, int rows, int cols) {
    return {std::max(region.x0 - across, 0), std::max(region.y0 - down, 0),
            std::min(region.x1 + across, cols), std::min(region.y1 + down, rows)};
}

}  // namespace

LevelRegions find_level_regions(const Region& wanted, int rows, int cols, int radius, int reach,
                                double predicted, double uncertainty) {
    LevelRegions parts{wanted, expanded(wanted, radius, radius, rows, cols), 0, 0, {}, {}};
    const double least = parts.pooled.x0 - predicted - uncertainty - 1.0,
                 most = parts.pooled.x1 - predicted + uncertainty + 1.0;
    parts.first = static_cast<int>(std::clamp(std::floor(least), 0.0, cols - 1.0));
    parts.last = static_cast<int>(std::clamp(std::ceil(most), 0.0, cols - 1.0));
    parts.left = expanded(parts.pooled, reach + 1, reach, rows, cols);
    parts.right = expanded({parts.first, parts.pooled.y0, parts.last + 1, parts.pooled.y1}, reach + 2, reach,
                           rows, cols);
    return parts;
}

GradientLevel::GradientLevel(const GrayLevel& left, const GrayLevel& right, const LevelRegions& parts,
                             const GaussianDerivative& filter, int radius, const DisparityPrior& known,
                             bool finest)
    : radius_(radius),
      rows_(left.rows()),
      count_(finest ? kMeans : 2),
      wanted_(parts.wanted),
      pooled_(parts.pooled),
      left_(left, filter, std::max(pooled_.x0 - 1, 0), std::min(pooled_.x1 + 1, left.cols()), 1),
      right_(right, filter, std::max(parts.first - 1, 0), std::min(parts.last + 3, left.cols()), 2),
      incoming_(known, pooled_.x0, pooled_.x1, parts.first, parts.last, left.cols()),
      center_(known, wanted_.x0, wanted_.x1, parts.first, parts.last, left.cols()),
      taps_(static_cast<std::size_t>(kTaps * whole_lines(pooled_.x1 - pooled_.x0))),
      shifted_(taps_.size() / kTaps),
      slope_(shifted_.size()),
      rings_{ring(true), ring(true), ring(finest), ring(finest), ring(finest)},
      columns_(static_cast<int>(count_), wanted_.x1 - wanted_.x0 + 2 * radius + kRowLine),
      means_(static_cast<int>(count_), wanted_.x1 - wanted_.x0) {}

/// A line of room for the rest of rows that are shorter, but begin later.
RowRingBuffer GradientLevel::ring(bool wanted) const {
    return {wanted ? 2 * radius_ + 1 : 1, wanted_.x1 - wanted_.x0 + 2 * radius_ + kRowLine};
}

void GradientLevel::add_row(int y) {
    latest_ = y;
    const int skip = pooled_.x0 - (wanted_.x0 - radius_), n = pooled_.x1 - pooled_.x0, whole = whole_lines(n);
    if (y < 0 || y >= rows_) {  // 0 beyond the picture
        for (std::size_t mean = 0; mean < count_; ++mean) std::fill_n(rings_[mean].row(y) + skip, n, 0.0F);
        return;
    }
    incoming_.move_to(y);
    const float* left = left_.row(y) + pooled_.x0;
    gather(right_.row(y), incoming_.column(), n, taps_.data());
    interpolate(taps_.data(), incoming_.share(), whole, shifted_.data(), slope_.data());
    const Equations row{left, shifted_.data(), slope_.data(), incoming_.visible(), incoming_.offset()};
    Products out{rings_[0].row(y) + skip, rings_[1].row(y) + skip, nullptr, nullptr, nullptr};
    if (count_ > 2) {
        out.tt = rings_[2].row(y) + skip;
        out.power = rings_[3].row(y) + skip;
        out.reliability = rings_[4].row(y) + skip;
        multiply_finest(row, whole, out);
    } else {
        multiply(row, whole, out);
    }
    const int beyond = wanted_.x1 + radius_ - pooled_.x1;  // columns right of the picture
    for (std::size_t mean = 0; beyond > 0 && mean < count_; ++mean)
        std::fill_n(rings_[mean].row(y) + skip + n, beyond, 0.0F);
}

WindowMeans GradientLevel::means(float* reliability) {
    const int side = 2 * radius_ + 1, n = wanted_.x1 - wanted_.x0;
    std::array<BoxFilter, kMeans> filters{};
    for (std::size_t mean = 0; mean < count_; ++mean) {
        const auto row = static_cast<int>(mean);
        filters[mean] = {rings_[mean].from(latest_ - side + 1), columns_.row(row), means_.row(row)};
    }
    box_filter_rows(filters.data(), static_cast<int>(count_), side, n);
    if (reliability != nullptr) std::copy_n(filters[kMeans - 1].mean, n, reliability);
    return {filters[0].mean, filters[1].mean, filters[2].mean, filters[3].mean, filters[4].mean};
}

}  // namespace tricue
