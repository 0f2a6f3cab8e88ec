// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace tricue {

/// The radius for the flow and depth tracker's sigma, 0.8 pixels, for which filters are compiled separately.
constexpr int kUsualRadius = 3;

/// The weights of GaussianTaps, as multiversioned functions take them.
struct TapView {
    int radius;
    const float *smooth, *slope, *curvature;  ///< radius + 1
};

/// A Gaussian and its first two derivatives, sampled and cut off at 3.5 sigma, as weights to correlate with: those of
/// the pixels at distance 0 to radius on the right of (below) the middle. To the left slope has the other sign, the others the same.
///
/// Scaled so that they are exact on polynomials: smooth sums to 1, slope gives 1 on the ramp x, curvature gives 0 on a constant
/// and 2 on the parabola x^2. For waves with w sigma <= 1.5, slope^2 / curvature is right to 2 % from sigma 1.5 on, and to 3 % at
/// 1; cut off at 3 sigma it would be 7 % off.
struct GaussianTaps {
    explicit GaussianTaps(double sigma);

    TapView view() const { return {radius, smooth.data(), slope.data(), curvature.data()}; }

    int radius;
    std::vector<float> smooth, slope, curvature;
};

/// Throws std::invalid_argument unless it is 0.5 to 16 pixels.
void require_sigma(double sigma);

/// A row and the outputs of its filters along x; the curvature may be nullptr if it isn't wanted. Each must be writable up to a
/// whole number of blocks (row_block.hpp), and the row readable up to that and the filters' radius on both sides. Numbers read
/// beyond the row affect only outputs beyond it.
struct AcrossFilters {
    const float* row;
    float *smooth, *slope, *curvature;
};

/// Filters some rows of n pixels, all with the curvature or all without.
void filter_across(const AcrossFilters* rows, int count, const GaussianTaps& taps, int n);

}  // namespace tricue
