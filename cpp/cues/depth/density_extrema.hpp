// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

struct Extrema {
    Indices maxima;  ///< int64 (M,): levels of the maxima, ascending
    /// int64 (M - 1,): levels of the minima, one between each two maxima; (0,) without maxima
    Indices minima;
};

/// Maxima of a depth density, and the minima between them: where objects are, and what divides them.
///
/// Outside the levels the density counts as 0, so a maximum may be at an end. The maximum of a plateau is its middle, rounded down.
/// The prominence of a maximum is how far the density falls on the way to anything higher, or to both ends, on the side where it
/// falls less. Of equal minima the first is given. O(L (M + 1)).
///
/// @param density float64 (L,), finite, none negative
/// @param prominence smallest prominence of a maximum, in the density's units, at least 0
/// @throws std::invalid_argument on another density or prominence
/// Source: Sabeti, Parvizi, Wu 2008, equations (32)-(34), section IV.A; the prominence is ours.
Extrema density_extrema(VectorRef density, double prominence);

}  // namespace tricue
