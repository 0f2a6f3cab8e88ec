// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// Distance of every histogram to the model: d = sqrt(1 - (1/G) sum_k sqrt(p_k q_k)), G groups of sum 1 each.
///
/// @param histograms (N, K), none negative
/// @param model      (1, K), none negative
/// @param groups     how many histograms stand side by side in a row (3 for three channels); divides K
/// @returns          (N,) in [0, 1]; sums that rounding puts above 1 count as 1
/// @throws std::invalid_argument on other widths, negative or infinite entries, NaN, groups that don't divide K
/// Source: Bhattacharyya 1943, in the form of Comaniciu, Ramesh, Meer 2003.
Vector bhattacharyya(FloatsRef histograms, FloatsRef model, int groups);

}  // namespace tricue
