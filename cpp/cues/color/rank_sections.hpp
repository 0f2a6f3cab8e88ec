// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// The paper's description of a window: sums of rank measures a^k(n) in S sections of the ranks of channel k.
///
///   (17)       r(l) = sum_{j <= l} H(j) / sum_j H(j), the rank of level l, for all 256 levels
///   (19)-(24)  q(n) = the r(l) closest to n/S, the lowest l of equals, for n = 0 ... S
///   (25)-(28)  a(n) = sum of r(l) over the levels with r(l) in the closed interval U = [q(n), q(n+1)]
///
/// The sums run over levels, not pixels, as printed: a level that no sample has counts too, and one whose
/// rank is a border q(n) counts in the sections on both sides. The paper defines q for n < S; q(S), which U
/// needs, is the rank closest to 1. One departure: every a^k is divided by its sum, as (29) is not in [0, 1]
/// otherwise.
///
/// @param samples  (N, 3, n), n at least 1
/// @param sections S, 1 to 256
/// @returns        (3N, S): a row for blue, green, red of every ellipse, each of sum 1
/// @throws std::invalid_argument on sections outside [1, 256], or on n = 0
/// Source: Sabeti, Parvizi, Wu 2008, section III.B.
Floats rank_sections(const SampleView& samples, int sections);

}  // namespace tricue
