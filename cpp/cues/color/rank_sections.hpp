// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// Sums of rank measures a^k(n) over S sections of the ranks of channel k, which describe a window:
///     (17)       r(l) = Σ_{j <= l} H(j) / Σ_j H(j), the rank of level l, for all 256 levels
///     (19)-(24)  q(n) = the r(l) closest to n/S, the lowest l of equals, for n = 0 ... S
///     (25)-(28)  a(n) = Σ r(l) over the levels with r(l) in the closed interval U = [q(n), q(n+1)]
///
/// As printed, the sums run over levels, not pixels: a level without samples counts too, and one whose rank is a border q(n) counts
/// on both sides. The paper defines q for n < S; q(S), which U needs, is the rank closest to 1. Unlike the paper, every a^k is
/// divided by its sum, as (29) is not in [0, 1] otherwise.
///
/// @param samples uint8 (N, 3, n): N ellipses, channels B, G, R, n at least 1
/// @param sections S, 1 to 256
/// @returns float32 (N, 3, S), each of sum 1 over the sections; in C++ 3 N rows
/// @throws std::invalid_argument on sections outside [1, 256], or n = 0
/// Source: Sabeti, Parvizi, Wu 2008, section III.B.
Floats rank_sections(const SampleView& samples, int sections);

}  // namespace tricue
