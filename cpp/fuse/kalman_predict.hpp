// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// A filter's estimate of a state of D numbers.
struct Belief {
    Vector mean;        ///< float64 (D,), x'
    States covariance;  ///< float64 (D, D), P', symmetric to the last bit
};

/// Kalman prediction: x' = F x,  P' = F P Fᵀ + Q.
///
/// @param mean float64 (D,), x, D at least 1
/// @param covariance float64 (D, D), P
/// @param transition float64 (D, D), F
/// @param noise float64 (D, D), Q: covariance of the process noise
/// @throws std::invalid_argument on other shapes, numbers that are not finite, or invalid covariances
/// Source: Kalman 1960; Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, equation (6) and step 1, where F = I.
Belief kalman_predict(VectorRef mean, StatesRef covariance, StatesRef transition, StatesRef noise);

}  // namespace tricue
