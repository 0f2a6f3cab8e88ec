// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

struct Summary {
    Vector mean;        ///< float64 (D,): expected value
    States covariance;  ///< float64 (D, D): symmetric, divided by the sum of the weights: 0 for one particle
    double effective;   ///< effective sample size (Σw)² / Σw², from 1 (one has it all) to N (all are equal)
};

/// Expected value, covariance and effective sample size of weighted particles.
///
/// @param particles float64 (N, D), finite
/// @param weights float64 (N,), finite, none negative, not all 0; need not sum to 1
/// @throws std::invalid_argument on different sizes or other numbers
/// Source: Sabeti, Parvizi, Wu 2008, section III.C (expected value); Kong, Liu, Wong 1994 (effective sample size).
Summary summarize(StatesRef particles, VectorRef weights);

/// The expected value (D,) alone.
Vector weighted_mean(StatesRef particles, VectorRef weights);

}  // namespace tricue
