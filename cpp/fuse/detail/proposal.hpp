// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// How particles move, equation (30) with the velocity in the mean: p(x' | x) = N(x + drift, diag(scale²)).
struct Dynamics {
    VectorRef drift;  ///< float64 (D,): displacement in a frame, in the units of the state, finite
    /// float64 (D,): standard deviations, none negative; those of a detection's K numbers above 0 where a density is needed
    VectorRef scale;
};

/// A detection of the target by low-level vision: N(mean, root rootᵀ) over a state's first K numbers, the position or all of it.
struct Detection {
    VectorRef mean;  ///< float64 (K,): mean of the detection, K at least 1, at most D
    /// float64 (K, K): Cholesky factor of its covariance, lower triangle, diagonal above 0; numbers above the diagonal are not
    /// read
    StatesRef root;
    /// share of the particles that is drawn from it, in [0, 1); at 0 mean and root are not read
    double share;
};

/// @throws std::invalid_argument on a wrong size or value for states with this many dimensions
void require_valid(const Dynamics& dynamics, Eigen::Index dimensions);
void require_valid(const Detection& detection, Eigen::Index dimensions);

}  // namespace tricue
