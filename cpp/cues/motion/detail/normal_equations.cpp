// SPDX-License-Identifier: MIT
#include "cues/motion/detail/normal_equations.hpp"

#include <array>
#include <cstddef>

namespace tricue {
namespace {

/// Rows, top row first, and where their mean goes.
struct WindowColumns {
    const float* const* rows;
    float* means;
};

/// kSide 0 stands for any side.
template <int kBytes, int kSide>
TRICUE_INLINE void average_down_by(const WindowColumns* rows, int count, int any_side, int n) {
    const int side = kSide > 0 ? kSide : any_side;
    const float share = 1 / static_cast<float>(side);
    for (int i = 0; i < count; ++i) {
        const WindowColumns window = rows[i];
        for (int x = 0; x < n; x += kRowLanes<kBytes>)
            average_lanes<kBytes>([=](int k) { return window.rows[k] + x; }, side, share, window.means + x);
    }
}

/// The same for a whole batch, which loads each row once.
template <int kBytes, int kSide>
TRICUE_INLINE void average_batch_down(const WindowColumns* windows, int n) {
    constexpr float kShare = 1 / static_cast<float>(kSide);
    constexpr auto kRows = static_cast<std::size_t>(kRowBatch + kSide - 1);
    for (int x = 0; x < n; x += kRowLanes<kBytes>) {
        RowLanes<kBytes> rows[kRows];
        for (int i = 0; i < kRowBatch; ++i) load(windows[i].rows[0] + x, rows[i]);
        for (int k = 1; k < kSide; ++k) load(windows[kRowBatch - 1].rows[k] + x, rows[kRowBatch - 1 + k]);
        for (int i = 0; i < kRowBatch; ++i) {
            RowLanes<kBytes> sum{}, mean{};
            for (int k = 0; k < kSide; ++k) add(1, rows[i + k], sum);
            add(kShare, sum, mean);
            store(mean, windows[i].means + x);
        }
    }
}

template <int kBytes>
TRICUE_INLINE void average_columns_by(const WindowColumns* rows, int count, int side, int n) {
    if (side == kDefaultFlowSide && count == kRowBatch)
        average_batch_down<kBytes, kDefaultFlowSide>(rows, n);
    else if (side == kDefaultFlowSide)
        average_down_by<kBytes, kDefaultFlowSide>(rows, count, side, n);
    else
        average_down_by<kBytes, 0>(rows, count, side, n);
}

TRICUE_MULTIWIDTH(average_columns, average_columns_by,
                  (const WindowColumns* rows, int count, int side, int n), (rows, count, side, n))

}  // namespace

// The last block of means reads past its end by a window's width.
NormalEquationRows::NormalEquationRows(int pool, int length)
    : pool_(pool),
      stride_(whole_blocks(length + 2 * pool)),
      products_(2 * pool + kRowBatch, 5 * stride_),
      means_(kRowBatch, 5 * stride_ + kRowBlock + 2 * pool) {}

NormalEquations NormalEquationRows::row(int y) {
    return {products_.row(y), stride_};
}

void NormalEquationRows::average_down(int begin, int end) {
    std::array<WindowColumns, kRowBatch> columns;
    for (int y = begin; y < end; ++y)
        columns[static_cast<std::size_t>(y - begin)] = {products_.from(y - pool_), means_.row(y)};
    average_columns(columns.data(), end - begin, 2 * pool_ + 1, 5 * stride_);
}

NormalEquations NormalEquationRows::means_down(int y) {
    return {means_.row(y), stride_};
}

}  // namespace tricue
