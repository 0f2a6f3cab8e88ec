// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/gradient_level.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kTaps = 4;  // of f_R: the two columns around x - d, and one more on each side

/// Copies all taps of a pixel at once: several times faster than a gather for each tap.
void gather(const float* f, const int* column, int n, float* taps) {
    for (int x = 0; x < n; ++x) std::memcpy(taps + kTaps * x, f + column[x] - 1, kTaps * sizeof(float));
}

/// The inputs of equation (7) in a row: f_L, f_R around x - d, and the expected disparities; and the output for its terms.
struct EquationRow {
    const float *left, *taps;
    WarpedRow known;
    float* ss;
};

/// f_R and f_x^R between columns, then the terms. n is a number of blocks.
template <bool kFinest>
TRICUE_INLINE void multiply_by(const EquationRow* rows, int count, int n, int stride) {
    for (int i = 0; i < count; ++i) {
        const float *lefts = rows[i].left, *taps = rows[i].taps, *shares = rows[i].known.share,
                    *visibles = rows[i].known.visible, *offsets = rows[i].known.offset;
        float *ss = rows[i].ss, *st = ss + stride, *tt = st + stride, *power = tt + stride,
              *reliability = power + stride;
        // the rows don't overlap
        TRICUE_INDEPENDENT
        for (int x = 0; x < n; ++x) {
            const float before = taps[kTaps * x], at = taps[kTaps * x + 1], after = taps[kTaps * x + 2],
                        beyond = taps[kTaps * x + 3];
            const float first = after - before, second = beyond - at;  // twice the slopes of both columns
            const float right = at + shares[x] * (after - at);
            const float right_slope = 0.5F * (first + shares[x] * (second - first));
            const float left = lefts[x], left_slope = 0.5F * (lefts[x + 1] - lefts[x - 1]);
            const float visible = visibles[x];
            const float s = 0.5F * visible * (right_slope + left_slope);
            const float t = s * offsets[x] + visible * (right - left);
            ss[x] = s * s;
            st[x] = s * t;
            if (kFinest) {
                tt[x] = t * t;
                power[x] = visible * (left * left + right * right);
                reliability[x] = visible * (left_slope * left_slope + right_slope * right_slope);
            }
        }
    }
}

TRICUE_MULTIVERSION
void multiply(const EquationRow* rows, int count, int n, int stride) {
    multiply_by<false>(rows, count, n, stride);
}

TRICUE_MULTIVERSION
void multiply_finest(const EquationRow* rows, int count, int n, int stride) {
    multiply_by<true>(rows, count, n, stride);
}

/// Rows, top row first, and where their sum goes.
struct SummedRows {
    const float* const* rows;
    float* sum;
};

/// kSide 0 stands for any side.
template <int kBytes, int kSide>
TRICUE_INLINE void sum_down_by(const SummedRows* sums, int count, int any_side, int n) {
    const int side = kSide > 0 ? kSide : any_side;
    for (int i = 0; i < count; ++i) {
        const SummedRows each = sums[i];
        for (int x = 0; x < n; x += kRowLanes<kBytes>) {
            RowLanes<kBytes> sum, next;
            load(each.rows[0] + x, sum);
            for (int k = 1; k < side; ++k) {
                load(each.rows[k] + x, next);
                sum += next;
            }
            store(sum, each.sum + x);
        }
    }
}

/// The same for a whole batch, which loads each row once.
template <int kBytes, int kSide>
TRICUE_INLINE void sum_batch_down(const SummedRows* sums, int n) {
    constexpr auto kRows = static_cast<std::size_t>(kRowBatch + kSide - 1);
    for (int x = 0; x < n; x += kRowLanes<kBytes>) {
        RowLanes<kBytes> rows[kRows];
        for (int i = 0; i < kRowBatch; ++i) load(sums[i].rows[0] + x, rows[i]);
        for (int k = 1; k < kSide; ++k) load(sums[kRowBatch - 1].rows[k] + x, rows[kRowBatch - 1 + k]);
        for (int i = 0; i < kRowBatch; ++i) {
            RowLanes<kBytes> sum = rows[i];
            for (int k = 1; k < kSide; ++k) sum += rows[i + k];
            store(sum, sums[i].sum + x);
        }
    }
}

template <int kBytes>
TRICUE_INLINE void sum_down_of(const SummedRows* sums, int count, int side, int n) {
    if (side == kDefaultDisparitySide && count == kRowBatch)
        sum_batch_down<kBytes, kDefaultDisparitySide>(sums, n);
    else if (side == kDefaultDisparitySide)
        sum_down_by<kBytes, kDefaultDisparitySide>(sums, count, side, n);
    else
        sum_down_by<kBytes, 0>(sums, count, side, n);
}

TRICUE_MULTIWIDTH(sum_down, sum_down_of, (const SummedRows* sums, int count, int side, int n),
                  (sums, count, side, n))

Region expanded(const Region& region, int across, int down, int rows, int cols) {
    return {std::max(region.x0 - across, 0), std::max(region.y0 - down, 0),
            std::min(region.x1 + across, cols), std::min(region.y1 + down, rows)};
}

/// Numbers from one term to the next in a row. A row of terms may begin later than its windows' columns, and ends with a whole number
/// of blocks.
int stride_of(const LevelRegions& parts, int radius) {
    const int windows = parts.wanted.x1 - parts.wanted.x0 + 2 * radius;
    const int skipped = parts.pooled.x0 - (parts.wanted.x0 - radius);
    return whole_blocks(std::max(windows, skipped + whole_blocks(parts.pooled.x1 - parts.pooled.x0)));
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

GradientLevel::GradientLevel(const GrayPlane& left, const GrayPlane& right, const LevelRegions& parts,
                             const GaussianDerivative& filter, int radius, const DisparityPrior& known,
                             bool finest)
    : radius_(radius),
      rows_(left.rows()),
      count_(finest ? kTerms : 2),
      wanted_(parts.wanted),
      pooled_(parts.pooled),
      stride_(stride_of(parts, radius)),
      left_(left, filter, std::max(pooled_.x0 - 1, 0), std::min(pooled_.x1 + 1, left.cols()), 1),
      right_(right, filter, std::max(parts.first - 1, 0), std::min(parts.last + 3, left.cols()), 2),
      warped_(known, pooled_.x0, pooled_.x1, parts.first, parts.last, left.cols(), kRowBatch + radius + 1),
      taps_stride_(kTaps * whole_blocks(pooled_.x1 - pooled_.x0)),
      taps_(static_cast<std::size_t>(kRowBatch * taps_stride_)),
      terms_(2 * radius + kRowBatch, count_ * stride_),
      columns_(kRowBatch, count_ * stride_ + kRowBlock + 2 * radius) {}

/// Terms beyond the picture are 0.
void GradientLevel::add_rows(int begin, int end) {
    for (int y = begin; y < end; ++y)
        if (y < 0 || y >= rows_) std::fill_n(terms_.row(y), count_ * stride_, 0.0F);
    const int first = std::clamp(begin, 0, rows_), last = std::clamp(end, 0, rows_);
    if (first < last) add_visible_rows(first, last);
}

void GradientLevel::add_visible_rows(int begin, int end) {
    const int skip = pooled_.x0 - (wanted_.x0 - radius_), n = pooled_.x1 - pooled_.x0;
    left_.filter(begin, end);
    right_.filter(begin, end);
    std::array<EquationRow, kRowBatch> rows;
    for (int y = begin; y < end; ++y) {
        const auto i = static_cast<std::size_t>(y - begin);
        warped_.add_row(y);
        const WarpedRow known = warped_.row(y);
        float* taps = taps_.data() + (y - begin) * taps_stride_;
        gather(right_.row(y), known.column, n, taps);
        rows[i] = {left_.row(y) + pooled_.x0, taps, known, terms_.row(y) + skip};
    }
    (count_ == kTerms ? multiply_finest : multiply)(rows.data(), end - begin, whole_blocks(n), stride_);
    const int beyond = wanted_.x1 + radius_ - pooled_.x1;  // columns right of the picture
    for (int y = begin; beyond > 0 && y < end; ++y)
        for (int term = 0; term < count_; ++term)
            std::fill_n(terms_.row(y) + term * stride_ + skip + n, beyond, 0.0F);
}

void GradientLevel::sum_columns(int begin, int end) {
    std::array<SummedRows, kRowBatch> sums;
    for (int y = begin; y < end; ++y)
        sums[static_cast<std::size_t>(y - begin)] = {terms_.from(y - radius_), columns_.row(y)};
    sum_down(sums.data(), end - begin, 2 * radius_ + 1, count_ * stride_);
}

WarpedRow GradientLevel::known(int y) const {
    const WarpedRow row = warped_.row(y);
    const int skip = wanted_.x0 - pooled_.x0;
    return {row.offset + skip, row.share + skip, row.visible + skip, row.column + skip};
}

}  // namespace tricue
