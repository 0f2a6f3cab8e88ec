// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// A state after a measurement, and what tells whether they agree: y S⁻¹ yᵀ has M on average if noises are what they claim.
struct Correction {
    Vector mean;                   ///< D
    States covariance;             ///< D x D, symmetric to the last bit
    Vector innovation;             ///< y, M
    States innovation_covariance;  ///< S, M x M, symmetric to the last bit
};

/// Kalman update by a measurement z of M numbers:
///     y = z - H x,  S = H P Hᵀ + R,  K = P Hᵀ S⁻¹
///     x' = x + K y,  P' = (I - K H) P (I - K H)ᵀ + K R Kᵀ
/// Joseph's form of P', a sum of two squares: an error of K enters it to second order only, that of (I - K H) P, its equal, to
/// first. Beyond noises about 1e12 times smaller than P no form in double precision is safe.
///
/// @param mean        x, D numbers, at least one
/// @param covariance  P, D x D
/// @param measurement z, M numbers, at least one
/// @param observation H, M x D
/// @param noise       R, M x M, of the measurement; may be 0 where P makes S positive definite
/// @throws std::invalid_argument on other shapes, numbers that aren't finite, covariances that are none, and an S that isn't
///         positive definite
/// Source: Kalman 1960; Bucy, Joseph 1968; Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, steps 3 to 5, where H = I.
Correction kalman_update(VectorRef mean, StatesRef covariance, VectorRef measurement, StatesRef observation,
                         StatesRef noise);

}  // namespace tricue
