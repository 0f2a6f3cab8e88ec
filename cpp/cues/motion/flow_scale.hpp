// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/plane_view.hpp"

namespace tricue {

struct FlowScale {
    double a;            ///< how many times as large as now it was, NaN where the flow doesn't tell
    double spread;       ///< pixels², mean squared residual of the last fit; NaN with a
    std::int64_t count;  ///< pixels of the last fit, or, with a NaN, those that were too few for one
};

/// How much a flow field stretches: where the pixels (x, y) came from is a similarity without a turn,
///     x - u = a x + b,   y - v = a y + c,
/// by least squares over the n pixels where u and v are finite; with p = (x, y), f = (u, v)
///     a = 1 - s,   s = (Σ p f - Σp Σf / n) / (Σ p² - (Σp)² / n),   (b, c) = s Σp / n - Σf / n,
/// and once more without those whose squared residual |f - s p + (b, c)|² is above outliers² times the first fit's mean: at most
/// 1 / outliers² of all.
///
/// In float64, with x and y from the middle of the planes. A sum is four, of the columns x with one x mod 4, in each of which
/// pixels are added row by row from the left; then the first two plus the last two. So all machines give the same bits.
///
/// @param u, v     one shape, pixels a frame, NaN where unknown; pyramid_flow's
/// @param outliers finite and above 0
/// @param least    pixels that each fit needs, at least 1; where there are fewer, or just one, a and spread are NaN
/// @throws std::invalid_argument on unlike shapes, and on numbers out of range
/// Source: Umeyama 1991, equation (42) with R = 1, from the places now to those before; the second fit is one round of sigma
/// clipping.
FlowScale flow_scale(const PlaneView& u, const PlaneView& v, double outliers, int least);

}  // namespace tricue
