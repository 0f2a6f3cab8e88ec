// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "fuse/detail/proposal.hpp"

namespace tricue {

/// The bounds of a state.
struct Bounds {
    VectorRef lower;  ///< float64 (D,): lower bounds of a state, may be infinite
    VectorRef upper;  ///< float64 (D,): upper bounds, not below the lower ones, may be infinite
};

/// Draws the next particles from the mixture proposal: x' = x + drift + scale * noise, equation (30) with the velocity in the mean;
/// floor(share N) of them instead have their first K numbers at mean + root noise.
///
/// Those are spread evenly over the particles, which resampling leaves in the order of their ancestors. Both use the same row of
/// noise, so a particle's draw does not depend on which side of the share it falls. All are clamped to the bounds.
///
/// @param particles float64 (N, D), finite, the K numbers of a detection first
/// @param noise float64 (N, D): independent standard normal numbers
/// @returns float64 (N, D)
/// @throws std::invalid_argument on different sizes, numbers that are not finite, a negative scale, a share outside [0, 1), a
///     root without a positive diagonal, or bounds that cross
/// Source: Sabeti, Parvizi, Wu 2008, section III.A and equation (30).
States propose(StatesRef particles, const Dynamics& dynamics, StatesRef noise, const Detection& detection,
               const Bounds& bounds);

}  // namespace tricue
