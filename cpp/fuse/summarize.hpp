// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

struct Summary {
    Vector mean;        ///< D, the expected value
    States covariance;  ///< D x D, symmetric; divided by the sum of the weights, so 0 for one particle
    double
        effective;  ///< effective sample size (Σw)² / Σw², from 1 (one particle has it all) to N (all are equal)
};

/// The estimate that weighted particles stand for: expected value, covariance, effective sample size.
///
/// @param particles N states of D numbers, finite
/// @param weights   N weights, finite, not negative, not all zero; need not be normalised
/// @throws std::invalid_argument on sizes that don't agree or other numbers
/// Source: Sabeti, Parvizi, Wu 2008, section III.C (expected value); Kong, Liu, Wong 1994 (effective sample size).
Summary summarize(StatesRef particles, VectorRef weights);

}  // namespace tricue
