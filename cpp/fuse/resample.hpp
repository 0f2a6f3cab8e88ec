// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"

namespace tricue {

/// Systematic resampling: one comb of N equally spaced points, shifted by `offset`, through the cumulative weights.
///
/// Index i is the first particle whose cumulative weight exceeds (i + offset) / N of the total, so a particle of
/// normalised weight w is chosen floor(N w) or ceil(N w) times. Weights need not be normalised.
///
/// @param weights N weights, finite, not negative, not all zero
/// @param offset  the comb's shift, in [0, 1)
/// @returns       N indices into the particles, ascending
/// @throws std::invalid_argument on empty, negative, non-finite or all-zero weights, or an offset outside [0, 1)
/// Source: the resampling that equation (1) presumes; Kitagawa 1996.
Indices resample(VectorRef weights, double offset);

}  // namespace tricue
