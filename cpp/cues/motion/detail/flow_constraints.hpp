// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cues/motion/detail/gaussian_rows.hpp"

namespace tricue {

/// The two constraints of each pixel of a row, equation (4) of Okada, Shirai and Miura 1996: with g and h the derivatives of a
/// Gaussian along x and y, (h*f)_x is (g*f)_y. Each readable up to whole blocks.
struct Constraints {
    const float *g_x, *g_y, *h_y, *g_t, *h_t;
};

/// Filters two frames, row by row from above: their mean in space, their difference in time.
class ConstraintRows {
public:
    /// @param length pixels of a row of constraints
    ConstraintRows(double sigma, int length);

    int radius() const { return taps_.radius; }

    /// Takes row y, from radius() before the first wanted to radius() after the last, y from -radius() on; each of
    /// length + 2 radius() pixels, beginning radius() left of the constraints.
    void push(int y, const float* before, const float* now);

    /// The constraints of row y, where rows y - radius() to y + radius() were the last pushed; until the next call.
    Constraints row(int y);

private:
    GaussianTaps taps_;
    int length_;
    std::vector<float> mean_, change_;
    RowRingBuffer mean_smooth_, mean_slope_, mean_curvature_, change_smooth_, change_slope_;  ///< along x
    RowRingBuffer result_;
};

}  // namespace tricue
