// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cues/stereo/detail/gray_plane.hpp"

namespace tricue {

/// The disparities expected at a level before it is measured: base + 2 coarse + rest, with `coarse` those of the next coarser
/// level, or base + rest everywhere. The base is an integer, so that floats keep the fractions far from the left edge.
struct DisparityPrior {
    int base;
    float rest;
    const GrayPlane* coarse;  ///< or nullptr
};

/// Where the pixels of a row of the left picture are in the right one: x - d for the expected disparity d. All can be read for
/// one more block.
struct WarpedRow {
    const float* offset;   ///< d - base
    const float* share;    ///< weight of the next column
    const float* visible;  ///< 1 where x - d lies in the picture, else 0
    const int* column;     ///< x - d rounded down, clamped to [first, last]
};

/// The last computed rows.
class WarpedColumns {
public:
    /// @param x0, x1       the left picture's columns
    /// @param first, last  those of the right picture that can be read
    /// @param cols         of the whole picture
    /// @param kept         rows that are kept
    WarpedColumns(const DisparityPrior& prior, int x0, int x1, int first, int last, int cols, int kept);

    /// Computes row y; rows are computed from the top.
    void add_row(int y);

    /// Row y from x0 on.
    WarpedRow row(int y) const;

private:
    void update(std::size_t slot);
    /// Two rows share one of the coarser level.
    std::size_t slot(int y) const {
        return prior_.coarse == nullptr ? 0 : static_cast<std::size_t>(y / 2 & last_slot_);
    }

    DisparityPrior prior_;
    int x0_, first_, last_, cols_;
    int skip_;   ///< 1 where x0 is odd: columns begin at an even one, two for each of the coarser level
    int pairs_;  ///< of columns
    int row_ = -1, last_slot_;
    std::size_t stride_;
    std::vector<float> offset_, share_, visible_;
    std::vector<int> column_;
};

}  // namespace tricue
