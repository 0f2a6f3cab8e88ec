// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// Distance of rank sections to the model's: d = 1/(3 sqrt 2) sum_k sqrt(sum_n (a^k(n) - m^k(n))^2).
///
/// (29) itself reaches 3 sqrt 2 on sections that sum to 1 (sqrt 2 a channel, where two have nothing in
/// common); divided by it the distance lies in [0, 1], which the likelihood 1 - d of (18) presumes.
///
/// @param sections (3N, S), three rows an ellipse, from rank_sections
/// @param model    (3, S)
/// @returns        (N,)
/// @throws std::invalid_argument on numbers of sections that differ
/// Source: Sabeti, Parvizi, Wu 2008, equation (29).
Vector section_distance(FloatsRef sections, FloatsRef model);

}  // namespace tricue
