// SPDX-License-Identifier: MIT
#pragma once

#include "base/row_block.hpp"
#include "base/row_ring_buffer.hpp"
#include "base/simd.hpp"
#include "cues/motion/detail/flow_constraints.hpp"

namespace tricue {

/// Averages the normal equations over squares of 2 pool + 1 pixels: down the columns here, across them by average_across.
class NormalEquationRows {
public:
    /// @param length pixels of an averaged row
    NormalEquationRows(int pool, int length);

    /// The place for row y, from -pool on, of length + 2 pool pixels, beginning pool left of the averaged ones.
    NormalEquations row(int y);

    /// Computes the means down the columns for rows [begin, end), a batch or fewer, from rows begin - pool to end - 1 + pool.
    void average_down(int begin, int end);

    /// The means for a row, of length + 2 pool pixels; the last batch is kept.
    NormalEquations means_down(int y);

private:
    int pool_, stride_;
    RowRingBuffer products_, means_;
};

/// A block of normal equations, averaged.
struct MeanBlock {
    float xx[kRowBlock], xy[kRowBlock], yy[kRowBlock], xt[kRowBlock], yt[kRowBlock];
};

/// The means of the pixels of a register.
template <int kBytes, typename Next>
TRICUE_INLINE void average_lanes(const Next& next, int count, float share, float* out) {
    RowLanes<kBytes> sum{}, pixels, mean{};
    for (int i = 0; i < count; ++i) {
        load(next(i), pixels);
        add(1, pixels, sum);
    }
    add(share, sum, mean);
    store(mean, out);
}

/// The means of windows `side` pixels wide in the block from x on, from those down their columns.
template <int kBytes>
TRICUE_INLINE void average_across(const NormalEquations& columns, int side, int x, MeanBlock& means) {
    const float share = 1 / static_cast<float>(side);
    const auto average = [=](int plane, float* out) {
        const float* row = columns.xx + plane * columns.stride + x;
        for (int k = 0; k < kRowBlock; k += kRowLanes<kBytes>)
            average_lanes<kBytes>([=](int i) { return row + k + i; }, side, share, out + k);
    };
    average(0, means.xx);
    average(1, means.xy);
    average(2, means.yy);
    average(3, means.xt);
    average(4, means.yt);
}

/// The side of the flow and depth tracker's windows, for which means are compiled separately.
constexpr int kDefaultFlowSide = 5;

}  // namespace tricue
