// SPDX-License-Identifier: MIT
#include "cues/motion/detail/flow_constraints.hpp"

#include <array>

#include "base/row_block.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

/// The rows filtered along x around the wanted one, top row first, and the distance between their planes in numbers.
struct RowsAround {
    const float* const* rows;
    int stride;
};

template <typename Lanes>
struct ConstraintLanes {
    Lanes g_x, g_y, h_y, g_t, h_t;
};

/// A filter along y with equal weights above and below, or, if odd, weights of opposite sign.
template <bool kOdd, typename Lanes>
TRICUE_INLINE void filter_down(const float* const* rows, const float* weights, int radius, int x,
                               Lanes& total) {
    Lanes middle, above, below, sum, difference;
    total = Lanes{};
    load(rows[radius] + x, middle);
    if (!kOdd) add(weights[0], middle, total);
    for (int k = 1; k <= radius; ++k) {
        load(rows[radius - k] + x, above);
        load(rows[radius + k] + x, below);
        sum_and_difference(above, below, sum, difference);
        add(weights[k], kOdd ? difference : sum, total);
    }
}

template <typename Lanes>
TRICUE_INLINE void constrain(const RowsAround& around, const TapView& taps, int radius, int x,
                             ConstraintLanes<Lanes>& out) {
    const float* const* rows = around.rows;
    const int stride = around.stride;
    filter_down<false>(rows, taps.curvature, radius, x, out.h_y);
    filter_down<true>(rows, taps.slope, radius, stride + x, out.g_y);
    filter_down<false>(rows, taps.smooth, radius, 2 * stride + x, out.g_x);
    filter_down<true>(rows, taps.slope, radius, 3 * stride + x, out.h_t);
    filter_down<false>(rows, taps.smooth, radius, 4 * stride + x, out.g_t);
}

/// kRadius 0 stands for any radius.
template <int kBytes, int kRadius>
TRICUE_INLINE void multiply_by(const RowsAround* rows, int count, const TapView& taps, int n,
                               const NormalEquations* out) {
    const TapView weights = taps;
    const int radius = kRadius > 0 ? kRadius : weights.radius;
    for (int i = 0; i < count; ++i) {
        const RowsAround around = rows[i];
        const NormalEquations to = out[i];
        for (int x = 0; x < n; x += kRowLanes<kBytes>) {
            ConstraintLanes<RowLanes<kBytes>> row;
            constrain(around, weights, radius, x, row);
            const RowLanes<kBytes>& h_x = row.g_y;
            float* xx = to.xx + x;
            store(row.g_x * row.g_x + h_x * h_x, xx);
            store(row.g_x * row.g_y + h_x * row.h_y, xx + to.stride);
            store(row.g_y * row.g_y + row.h_y * row.h_y, xx + 2 * to.stride);
            store(row.g_x * row.g_t + h_x * row.h_t, xx + 3 * to.stride);
            store(row.g_y * row.g_t + row.h_y * row.h_t, xx + 4 * to.stride);
        }
    }
}

template <int kBytes>
TRICUE_INLINE void multiply_rows_by(const RowsAround* rows, int count, const TapView& taps, int n,
                                    const NormalEquations* out) {
    if (taps.radius == kUsualRadius)
        multiply_by<kBytes, kUsualRadius>(rows, count, taps, n, out);
    else
        multiply_by<kBytes, 0>(rows, count, taps, n, out);
}

template <int kBytes>
TRICUE_INLINE void write_row_by(const RowsAround& rows, const TapView& taps, int n, const Constraints& out) {
    const RowsAround around = rows;
    const TapView weights = taps;
    const Constraints to = out;
    for (int x = 0; x < n; x += kRowLanes<kBytes>) {
        ConstraintLanes<RowLanes<kBytes>> row;
        constrain(around, weights, weights.radius, x, row);
        float* g_x = to.g_x + x;
        store(row.g_x, g_x);
        store(row.g_y, g_x + to.stride);
        store(row.h_y, g_x + 2 * to.stride);
        store(row.g_t, g_x + 3 * to.stride);
        store(row.h_t, g_x + 4 * to.stride);
    }
}

TRICUE_MULTIWIDTH(multiply_rows, multiply_rows_by,
                  (const RowsAround* rows, int count, const TapView& taps, int n, const NormalEquations* out),
                  (rows, count, taps, n, out))
TRICUE_MULTIWIDTH(write_row, write_row_by,
                  (const RowsAround& rows, const TapView& taps, int n, const Constraints& out),
                  (rows, taps, n, out))

}  // namespace

ConstraintRows::ConstraintRows(const GaussianTaps& taps, int length)
    : taps_(taps),
      length_(length),
      compared_stride_(whole_blocks(length + 2 * taps_.radius)),
      filtered_stride_(whole_blocks(length)),
      compared_(kRowBatch, 2 * compared_stride_ + kRowBlock),  // the last block reads past the end
      filtered_(2 * taps_.radius + kRowBatch, 5 * filtered_stride_) {}

void ConstraintRows::push(int begin, int end) {
    std::array<AcrossFilters, kRowBatch> means, changes;
    for (int y = begin; y < end; ++y) {
        const auto i = static_cast<std::size_t>(y - begin);
        const auto plane = [&](int k) { return filtered_.row(y) + k * filtered_stride_; };
        means[i] = {mean(y) + taps_.radius, plane(0), plane(1), plane(2)};
        changes[i] = {change(y) + taps_.radius, plane(3), plane(4), nullptr};
    }
    filter_across(means.data(), end - begin, taps_, length_);
    filter_across(changes.data(), end - begin, taps_, length_);
}

void ConstraintRows::write(int y, const Constraints& row) const {
    write_row({filtered_.from(y - taps_.radius), filtered_stride_}, taps_.view(), length_, row);
}

void ConstraintRows::multiply(int y, int count, const NormalEquations* rows) const {
    std::array<RowsAround, kRowBatch> around;
    for (int i = 0; i < count; ++i)
        around[static_cast<std::size_t>(i)] = {filtered_.from(y + i - taps_.radius), filtered_stride_};
    multiply_rows(around.data(), count, taps_.view(), length_, rows);
}

}  // namespace tricue
