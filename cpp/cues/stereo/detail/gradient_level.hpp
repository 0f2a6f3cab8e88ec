// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "base/row_block.hpp"
#include "base/row_ring_buffer.hpp"
#include "base/simd.hpp"
#include "cues/stereo/detail/gaussian_derivative.hpp"
#include "cues/stereo/detail/gray_plane.hpp"
#include "cues/stereo/detail/warped_columns.hpp"

namespace tricue {

/// Sums down the columns of the windows around the pixels of a row, side by side, each `stride` numbers after the one before. With
/// s = (f_x^R + f_x^L) / 2 and t = s offset + f^R - f^L, equation (7) says t = s times the wanted offset d - base; f is the derivative
/// along x of the smoothed brightness. They are s², s t, and of the finest level t², f_L² + f_R² and (9).
struct WindowColumns {
    const float* ss;
    int stride;
    int side;  ///< a window's width in pixels: this many columns are summed
};

/// A row of a level: its columns, and the expected disparities of its pixels.
struct LevelRow {
    WindowColumns columns;
    WarpedRow known;
};

/// A block of windows' means.
struct WindowMeans {
    float ss[kRowBlock], st[kRowBlock], tt[kRowBlock], power[kRowBlock], reliability[kRowBlock];
};

/// The side of the flow and depth tracker's windows, for which means are compiled separately.
constexpr int kDefaultDisparitySide = 5;

/// The mean of one of the terms in the block of windows from x on. Each sum adds the columns in order, so it is the same to the
/// bit wherever the window is, unlike running sums.
template <int kBytes>
TRICUE_INLINE void mean_of(const WindowColumns& columns, int term, int side, int x, float* means) {
    const float* row = columns.ss + term * columns.stride + x;
    for (int i = 0; i < kRowBlock; i += kRowLanes<kBytes>, row += kRowLanes<kBytes>) {
        RowLanes<kBytes> sum, next;
        load(row, sum);
        for (int k = 1; k < side; ++k) {
            load(row + k, next);
            sum += next;
        }
        store(1.0F / static_cast<float>(side * side) * sum, means + i);
    }
}

/// The parts of its pictures that a level needs; inside them, not empty.
struct LevelRegions {
    Region wanted;       ///< the pixels to measure
    Region pooled;       ///< those of their windows
    int first, last;     ///< columns of the right picture where these pixels can be, inclusive
    Region left, right;  ///< what filters read
};

/// @param predicted   disparity, pixels of this level
/// @param uncertainty how far from that the expected disparities may be
LevelRegions find_level_regions(const Region& wanted, int rows, int cols, int radius, int reach,
                                double predicted, double uncertainty);

/// One level of gradient_disparity, a batch of rows at a time.
class GradientLevel {
public:
    /// @param left, right show parts.left and parts.right
    /// @param finest      all terms are wanted, else two
    GradientLevel(const GrayPlane& left, const GrayPlane& right, const LevelRegions& parts,
                  const GaussianDerivative& filter, int radius, const DisparityPrior& known, bool finest);

    /// Calls done(y, rows, count) for `count` rows from y on, a batch or fewer, until all are done.
    template <typename Done>
    void run(const Done& done) {
        for (int y = wanted_.y0 - radius_; y < wanted_.y1 + radius_; y += kRowBatch) {
            const int end = std::min(y + kRowBatch, wanted_.y1 + radius_);
            add_rows(y, end);
            const int first = std::max(y - radius_, wanted_.y0);
            sum_columns(first, end - radius_);
            std::array<LevelRow, kRowBatch> rows;
            for (int row = first; row < end - radius_; ++row)
                rows[static_cast<std::size_t>(row - first)] = {columns(row), known(row)};
            if (first < end - radius_) done(first, rows.data(), end - radius_ - first);
        }
    }

private:
    static constexpr int kTerms = 5;

    void add_rows(int begin, int end);
    void add_visible_rows(int begin, int end);
    void sum_columns(int begin, int end);
    WindowColumns columns(int y) { return {columns_.row(y), stride_, 2 * radius_ + 1}; }
    WarpedRow known(int y) const;

    int radius_, rows_;
    int count_;  ///< of terms: 2 or kTerms
    Region wanted_, pooled_;
    int stride_;  ///< numbers from one term to the next in a row
    DerivativeRows left_, right_;
    WarpedColumns warped_;
    std::ptrdiff_t taps_stride_;
    std::vector<float> taps_;  ///< a batch of rows
    RowRingBuffer terms_, columns_;
};

}  // namespace tricue
