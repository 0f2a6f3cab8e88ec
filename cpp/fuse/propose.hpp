// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "fuse/detail/proposal.hpp"

namespace tricue {

/// How far a state may go, per dimension: lower <= upper, either may be infinite.
struct Bounds {
    VectorRef lower;
    VectorRef upper;
};

/// Draws the next particles from the mixture proposal: x' = x + drift + scale * noise, equation (30) with the velocity in
/// the mean; floor(share N) of them instead have their first K numbers at mean + root * noise. Those are spread evenly over the
/// particles, which resampling leaves in the order of their ancestors. The same row of noise serves both, so a particle's
/// draw doesn't depend on which side of the share it falls. All are clamped to the bounds.
///
/// @param particles N states of D numbers, those that a detection is about first
/// @param noise     N x D independent standard normal numbers
/// @returns         N x D
/// @throws std::invalid_argument on sizes that don't agree, numbers that aren't finite, a negative scale, a share outside
///         [0, 1), a root without a positive diagonal, or bounds that cross
/// Source: Sabeti, Parvizi, Wu 2008, section III.A and equation (30).
States propose(StatesRef particles, const Dynamics& dynamics, StatesRef noise, const Detection& detection,
               const Bounds& bounds);

}  // namespace tricue
