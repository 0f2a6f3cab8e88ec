// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// Distance of rank sections to a model: d = 1/(3 sqrt 2) Σ_k sqrt(Σ_n (a^k(n) - m^k(n))²).
///
/// Equation (29) reaches 3 sqrt 2 on sections of sum 1; divided by that the distance is in [0, 1], which the likelihood 1 - d of
/// (18) presumes.
///
/// @param sections float32 (N, 3, S), as rank_sections gives them; in C++ 3 N rows
/// @param model float32 (3, S)
/// @returns float64 (N,)
/// @throws std::invalid_argument on different numbers of sections
/// Source: Sabeti, Parvizi, Wu 2008, equation (29).
Vector section_distance(FloatsRef sections, FloatsRef model);

}  // namespace tricue
