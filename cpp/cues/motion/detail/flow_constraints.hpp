// SPDX-License-Identifier: MIT
#pragma once

#include "base/row_ring_buffer.hpp"
#include "cues/motion/detail/gaussian_rows.hpp"

namespace tricue {

/// The two constraints of each pixel of a row, equation (4) of Okada, Shirai and Miura 1996: with g and h the derivatives of a
/// Gaussian along x and y, (h*f)_x is (g*f)_y. g_x, g_y, h_y, g_t, h_t are side by side, each `stride` numbers after the previous
/// one.
struct Constraints {
    float* g_x;
    int stride;
};

/// The normal equations of two constraints per pixel, A^T A (xx, xy; xy, yy) and A^T b (xt, yt): xx, xy, yy, xt, yt side by side.
struct NormalEquations {
    float* xx;
    int stride;
};

/// Filters two frames row by row from the top: their mean in space, their difference in time. Rows are readable and writable up
/// to a whole number of blocks.
class ConstraintRows {
public:
    /// @param taps   are kept by reference
    /// @param length pixels of a row of constraints
    ConstraintRows(const GaussianTaps& taps, int length);

    int radius() const { return taps_.radius; }

    /// The place for row y of the frames' mean, and for its change from the first to the second, each of length + 2 radius()
    /// pixels, beginning radius() left of the constraints. A batch of rows is kept.
    float* mean(int y) { return compared_.row(y); }
    float* change(int y) { return compared_.row(y) + compared_stride_; }

    /// Takes rows [begin, end), at most a batch, whose mean and change have been written: each row once, from the top, from
    /// radius() before the first wanted row to radius() after the last.
    void push(int begin, int end);

    /// The constraints of row y, with rows y - radius() to y + radius() among the last pushed, up to a batch before the newest.
    void write(int y, const Constraints& row) const;

    /// Their normal equations for `count` rows, a batch or fewer, from y on.
    void multiply(int y, int count, const NormalEquations* rows) const;

private:
    const GaussianTaps& taps_;
    int length_;
    int compared_stride_, filtered_stride_;  ///< numbers from one plane to the next in a row
    RowRingBuffer compared_;                 ///< mean and change
    /// along x: the mean smoothed, its slope and curvature, the change smoothed, its slope
    RowRingBuffer filtered_;
};

}  // namespace tricue
