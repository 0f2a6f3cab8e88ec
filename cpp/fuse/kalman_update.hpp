// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "base/arrays.hpp"

namespace tricue {

/// A state after a measurement, and the innovation, which tells whether they agree: yᵀ S⁻¹ y is M on average if the noises are
/// right.
struct Correction {
    Vector mean;                   ///< float64 (D,), x'
    States covariance;             ///< float64 (D, D), P', symmetric to the last bit
    Vector innovation;             ///< float64 (M,), y
    States innovation_covariance;  ///< float64 (M, M), S, symmetric to the last bit
};

/// Kalman update by a measurement z:
///     y = z - H x,  S = H P Hᵀ + R,  K = P Hᵀ S⁻¹
///     x' = x + K y,  P' = (I - K H) P (I - K H)ᵀ + K R Kᵀ
///
/// A measurement that is farther off than max_distance, in standard deviations sqrt(yᵀ S⁻¹ y), shows that the motion model
/// failed: then P is first multiplied by yᵀ S⁻¹ y / max_distance², and S is computed from this larger P.
///
/// P' is in Joseph's form, a sum of two squares: an error of K enters it to second order only. With noises more than about 1e12
/// times smaller than P, no form is safe in double precision.
///
/// @param mean float64 (D,), x, D at least 1
/// @param covariance float64 (D, D), P
/// @param measurement float64 (M,), z, M at least 1
/// @param observation float64 (M, D), H
/// @param noise float64 (M, M), R: covariance of the measurement noise; may be 0 where P makes S positive definite
/// @param max_distance standard deviations, above 0; infinite to never widen P
/// @throws std::invalid_argument on other shapes, numbers that are not finite, invalid covariances, or an S that is not positive
///     definite
/// Source: Kalman 1960; Bucy, Joseph 1968; Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, steps 3 to 5, where H = I. A larger P
/// where the innovation is large: ours, as in fading memory.
Correction kalman_update(VectorRef mean, StatesRef covariance, VectorRef measurement, StatesRef observation,
                         StatesRef noise, double max_distance = std::numeric_limits<double>::infinity());

}  // namespace tricue
