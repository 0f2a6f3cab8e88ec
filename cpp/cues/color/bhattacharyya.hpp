// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// Bhattacharyya distance of each histogram to a model: d = sqrt(1 - 1/G Σ sqrt(p_k q_k)), for rows of G histograms of sum 1 each.
///
/// @param histograms float32 (N, K), none negative
/// @param model float32 (K,), none negative
/// @param groups G, the number of histograms side by side in a row, e.g. 3 for three channels; divides K
/// @returns float64 (N,) in [0, 1]; sums that rounding puts above 1 count as 1
/// @throws std::invalid_argument on other widths, negative or infinite entries, NaN, or groups that do not divide K
/// Source: Bhattacharyya 1943, in the form of Comaniciu, Ramesh, Meer 2003.
Vector bhattacharyya(FloatsRef histograms, FloatsRef model, int groups);

}  // namespace tricue
