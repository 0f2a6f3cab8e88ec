// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// What a filter believes of a state of D numbers.
struct Belief {
    Vector mean;        ///< D
    States covariance;  ///< D x D, symmetric to the last bit
};

/// Kalman prediction: x' = F x,  P' = F P Fᵀ + Q.
///
/// @param mean       x, D numbers, at least one
/// @param covariance P, D x D
/// @param transition F, D x D
/// @param noise      Q, D x D, of the process
/// @throws std::invalid_argument on other shapes, numbers that aren't finite, and covariances that are none
/// Source: Kalman 1960; Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, equation (6) and step 1, where F = I.
Belief kalman_predict(VectorRef mean, StatesRef covariance, StatesRef transition, StatesRef noise);

}  // namespace tricue
