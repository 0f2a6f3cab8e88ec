// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/row_ring_buffer.hpp"
#include "cues/motion/detail/row_block.hpp"

namespace tricue {

/// A Gaussian and its first two derivatives, sampled and cut off at 3.5 sigma, as weights to correlate with: those of
/// the pixels at distance 0 to radius on the right of (below) the middle. To the left slope has the other sign, the others the same.
///
/// Scaled so that they are exact on polynomials: smooth sums to 1, slope gives 1 on the ramp x, curvature
/// gives 0 on a constant and 2 on the parabola x^2. Of waves with w sigma <= 1.5 slope^2 / curvature is right to 2 % from sigma
/// 1.5 on, to 3 % at 1; cut off at 3 sigma it would be 7 % off.
struct GaussianTaps {
    explicit GaussianTaps(double sigma);

    int radius;
    std::vector<float> smooth, slope, curvature;
};

/// Throws std::invalid_argument unless it is 0.5 to 16 pixels.
void require_sigma(double sigma);

/// Rows are filtered a block at a time (row_block.hpp): each must be writable up to a whole number of blocks, and readable up to that
/// and the radius of the filter on both sides. What is read beyond the row counts only there.

/// Of one row its filters along x, n pixels each, in one pass; the second without the curvature.
void filter_across(const float* row, const GaussianTaps& taps, int n, float* smooth, float* slope,
                   float* curvature);
void filter_across(const float* row, const GaussianTaps& taps, int n, float* smooth, float* slope);

/// A filter along y, of 2 radius + 1 rows, the uppermost first: with weights that are the same above and below (smooth, curvature), or
/// of the other sign above (slope), which is odd.
struct ColumnFilter {
    const float* const* rows;
    const float* weights;  ///< radius + 1
    bool odd;
    float* out;
};

/// Some filters of one radius and n pixels each, in one call, as rows are short.
void filter_down(const ColumnFilter* filters, int count, int radius, int n);

}  // namespace tricue
