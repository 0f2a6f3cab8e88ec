// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace tricue {

/// A Gaussian and its first two derivatives, sampled and cut off at ceil(3 sigma), as weights to correlate with: those of
/// the pixels at distance 0 to radius on the right of (below) the middle. To the left slope has the other sign, the others the same.
///
/// Scaled so that of what is sampled exactly they make no error: bell sums to 1, slope gives 1 on the ramp x, curve
/// gives 0 on a constant and 2 on the parabola x^2.
struct GaussianTaps {
    explicit GaussianTaps(double sigma);

    int radius;
    std::vector<float> bell, slope, curve;
};

/// Throws std::invalid_argument unless it is 0.5 to 16 pixels.
void require_sigma(double sigma);

/// Rows are filtered a block at a time: each must be writable up to a whole number of blocks, and readable up to that and the
/// radius of the filter on both sides. What is read beyond the row counts only there.
constexpr int kRowBlock = 32;

constexpr int whole_blocks(int n) {
    return (n + kRowBlock - 1) / kRowBlock * kRowBlock;
}

/// Of one row its filters along x, n pixels each, in one pass; the second without the curve.
void filter_across(const float* row, const GaussianTaps& taps, int n, float* bell, float* slope,
                   float* curve);
void filter_across(const float* row, const GaussianTaps& taps, int n, float* bell, float* slope);

/// Along y, from 2 radius + 1 rows, the uppermost first: with weights that are the same above and below (bell, curve),
/// or of the other sign above (slope).
void filter_down(const float* const* rows, const std::vector<float>& weights, int n, float* out);
void slope_down(const float* const* rows, const std::vector<float>& weights, int n, float* out);

/// Rows of equal length that follow each other: a row takes the place of the one `count` above it.
class RowRing {
public:
    RowRing(int count, int length);
    RowRing(const RowRing&) = delete;  // a row's address would be of the other
    RowRing& operator=(const RowRing&) = delete;

    /// Any y from -count on.
    float* row(int y) { return first_ + static_cast<std::ptrdiff_t>((y + count_) % count_) * stride_; }

    /// The rows y - radius to y + radius; until the next call.
    const float* const* around(int y, int radius);

private:
    int count_;
    std::ptrdiff_t stride_;
    std::vector<float> data_;
    float* first_;
    std::vector<const float*> pointers_;
};

}  // namespace tricue
