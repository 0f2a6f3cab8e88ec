// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cues/stereo/detail/gray_plane.hpp"

namespace tricue {

/// The disparities that are known of a level before it is measured: base + 2 coarse + rest, of the next coarser level's pixel
/// over each, or base + rest everywhere. The base is a whole number, so that far from the left edge floats keep the fractions.
struct KnownDisparity {
    int base;
    float rest;
    const GrayPlane* coarse;  ///< or nullptr
};

/// Where the right image shows the pixels of one row of the left one, x - d for the known d.
class ShiftRow {
public:
    /// @param x0, x1       the left picture's columns
    /// @param first, last  those of the right picture that can be read
    /// @param cols         of the whole picture
    ShiftRow(const KnownDisparity& known, int x0, int x1, int first, int last, int cols);

    void move_to(int y);

    const float* offset() const { return offset_.data() + skip_; }  ///< of x0 and so on: d - base
    const int* column() const { return column_.data() + skip_; }    ///< x - d rounded down, in [first, last]
    const float* share() const { return share_.data() + skip_; }    ///< of the column after that
    const float* seen() const { return seen_.data() + skip_; }  ///< 1 where x - d lies in the picture, else 0

private:
    void locate();

    KnownDisparity known_;
    int x0_, first_, last_, cols_;
    int skip_;  ///< columns begin at an even one, so that the coarser level's pixels have two each
    int row_ = -1;
    std::vector<float> offset_, share_, seen_;
    std::vector<int> column_;
};

}  // namespace tricue
