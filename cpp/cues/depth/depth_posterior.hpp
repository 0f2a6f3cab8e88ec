// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// A grid of squares.
struct SampleGrid {
    double x0, y0;  ///< its top left corner, pixels, finite
    double step;    ///< width of a square, pixels, finite, above 0
    int rows;       ///< rows of the grid, 1 to 4096
    int columns;    ///< columns of the grid, 1 to 4096
};

/// The depth that a target should have.
struct ExpectedDepth {
    double expected;  ///< the target's expected depth, meters, finite, above 0
    double sigma;     ///< its standard deviation, meters, finite, above 0
    /// how much nearer a depth in front of the target is, meters, finite, at least 0
    double occluder_margin;
};

struct DepthPosterior {
    /// float32 (rows, columns): P(target | z), within 1e-6 of the exact one; 1/2 without a measurement
    Floats posterior;
    /// uint8 (rows, columns): 1 where z < expected - occluder_margin, else 0
    Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> nearer;
};

/// P(target | depth) on a grid of places, and which of them are in front of the target: Bayes' rule with equal priors
///     p / (p + c),  p = exp(-((z - expected) / sigma)² / 2),  c = 0.1
///
/// p is the target's likelihood, 1 at the expected depth, c that of everything else at any depth. z is the depth of the pixel under
/// the center (x0 + (j + 1/2) step, y0 + (i + 1/2) step) of square (i, j), in float64; pixel (i, j) of an image covers [j, j + 1) x
/// [i, i + 1).
///
/// @param depth float32 (H, W), meters; may be empty
/// @throws std::invalid_argument on numbers out of range
/// Source: ours.
DepthPosterior depth_posterior(const DepthView& depth, const SampleGrid& grid, const ExpectedDepth& target);

}  // namespace tricue
