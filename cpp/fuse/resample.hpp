// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// Systematic resampling: a comb of N equally spaced points, shifted by `offset`, through the cumulative weights.
///
/// Index i is the first particle whose cumulative weight exceeds (i + offset) / N of the total, so a particle of normalized weight
/// w is chosen floor(N w) or ceil(N w) times.
///
/// @param weights float64 (N,), finite, none negative, not all 0; need not sum to 1
/// @param offset shift of the comb, in [0, 1)
/// @returns int64 (N,): indices of particles, ascending
/// @throws std::invalid_argument on empty, negative, non-finite or all-zero weights, or an offset outside [0, 1)
/// Source: the resampling that equation (1) of Sabeti, Parvizi, Wu 2008 presumes; Kitagawa 1996.
Indices resample(VectorRef weights, double offset);

}  // namespace tricue
