// SPDX-License-Identifier: MIT
#pragma once

#include "camera/arrays.hpp"

namespace tricue {

/// How particles move, equation (30) with the velocity in the mean: p(x' | x) = N(x + drift, diag(scale²)).
struct Dynamics {
    VectorRef drift;  ///< D, a frame's displacement, in the units of the state
    VectorRef
        scale;  ///< D, standard deviations, none negative; those of the position above 0 where a density is needed
};

/// Where low-level vision sees the target: N(mean, root rootᵀ) over the position, a state's first two numbers.
struct Detection {
    VectorRef mean;  ///< 2
    StatesRef
        root;  ///< 2x2, lower triangle (Cholesky), diagonal above 0; what is above the diagonal is not read
    double share;  ///< of the particles that is drawn from it, in [0, 1); at 0 mean and root are not read
};

/// @throws std::invalid_argument on a wrong size or value; `states` has the number of dimensions, at least 2
void require_valid(const Dynamics& dynamics, Eigen::Index dimensions);
void require_valid(const Detection& detection);

}  // namespace tricue
