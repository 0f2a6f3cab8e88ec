// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Squares of `step` pixels, rows x columns of them, the first one's top left corner at (x, y); pixel (i, j) of an image covers
/// [j, j + 1) x [i, i + 1).
struct SampleGrid {
    double x, y, step;  ///< finite, step above 0
    int rows, columns;  ///< at least 1
};

/// The depth that a target should have.
struct ExpectedDepth {
    double expected, sigma;  ///< metres, finite, above 0
    double near_margin;      ///< metres, finite, not negative: what is nearer by more is before the target
};

struct DepthPosterior {
    Floats posterior;                                                                    ///< rows x columns
    Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> nearer;  ///< rows x columns
};

/// P(target | depth) on a grid of places, and what is before the target.
///
/// Bayes' rule with equal priors: p / (p + c), p = exp(-((z - expected) / sigma)² / 2) the target's likelihood, 1 at the expected depth,
/// c = 0.1 that of everything else, whatever its depth. Where nothing is measured, or outside the image, depth says nothing: 1/2.
/// z is the depth of the pixel in which a square's centre lies: (x + (j + 1/2) step, y + (i + 1/2) step), in float64, rounded down.
/// `nearer` is 1 where z < expected - near_margin, else 0. The posterior is within 1e-6 of the exact one.
///
/// @param depth metres; may be empty
/// @throws std::invalid_argument on numbers out of range
/// Source: ours; a Gaussian and a constant as likelihoods, as Sabeti, Parvizi, Wu 2008 have a Gaussian of depth.
DepthPosterior depth_posterior(const DepthView& depth, const SampleGrid& grid, const ExpectedDepth& target);

}  // namespace tricue
