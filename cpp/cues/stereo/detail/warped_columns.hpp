// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cues/stereo/detail/gray_plane.hpp"

namespace tricue {

/// The disparities expected at a level before it is measured: base + 2 coarse + rest with the next coarser level's, or base + rest
/// everywhere. The base is an integer, so that far from the left edge floats keep the fractions.
struct DisparityPrior {
    int base;
    float rest;
    const GrayPlane* coarse;  ///< or nullptr
};

/// Where the pixels of one row of the left picture are in the right one: x - d for the expected disparity d. All can be read for a
/// line more.
class WarpedColumns {
public:
    /// @param x0, x1       the left picture's columns
    /// @param first, last  those of the right picture that can be read
    /// @param cols         of the whole picture
    WarpedColumns(const DisparityPrior& prior, int x0, int x1, int first, int last, int cols);

    void move_to(int y);

    const float* offset() const { return offset_.data() + skip_; }  ///< d - base, from x0 on
    /// x - d rounded down, clamped to [first, last].
    const int* column() const { return column_.data() + skip_; }
    const float* share() const { return share_.data() + skip_; }  ///< weight of the next column
    /// 1 where x - d lies in the picture, else 0.
    const float* visible() const { return visible_.data() + skip_; }

private:
    void update_columns();

    DisparityPrior prior_;
    int x0_, first_, last_, cols_;
    int skip_;   ///< 1 where x0 is odd: columns begin at an even one, two for each of the coarser level
    int pairs_;  ///< of columns
    int row_ = -1;
    std::vector<float> offset_, share_, visible_;
    std::vector<int> column_;
};

}  // namespace tricue
