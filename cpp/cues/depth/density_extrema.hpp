// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

struct Extrema {
    Indices maxima;  ///< (M,) ascending
    Indices minima;  ///< (M - 1,), one between each maximum and the next; (0,) without maxima
};

/// Where a density has its maxima, (32), and between two of them its minimum, (33)-(34): where objects are, and what divides them.
///
/// Outside the levels the density counts as 0, so a maximum may be at an end. A plateau's maximum is its middle, rounded
/// down. A maximum is kept whose prominence is at least the one given: how far the density falls on the way to anything
/// higher, or to both ends, on the side where it falls less. Of equal minima the first is given. O(L (M + 1)).
///
/// @param density    (L,) finite, none negative
/// @param prominence in the density's units, at least 0
/// @throws std::invalid_argument on another density or prominence
/// Source: Sabeti, Parvizi, Wu 2008, equations (32)-(34), section IV.A; the prominence is ours.
Extrema density_extrema(VectorRef density, double prominence);

}  // namespace tricue
