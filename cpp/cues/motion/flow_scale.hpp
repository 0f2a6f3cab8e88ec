// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/plane_view.hpp"

namespace tricue {

struct FlowScale {
    double a;  ///< scale of the previous frame relative to this one; NaN with too few pixels, or just one
    double spread;       ///< mean squared residual of the last fit, pixels²; NaN with a
    std::int64_t count;  ///< pixels of the last fit, or, with a NaN, those that were too few for one
};

/// How much a flow field stretches: where the pixels (x, y) came from is a similarity without rotation,
///     x - u = a x + b,   y - v = a y + c
///
/// by least squares over the n pixels where u and v are finite; with p = (x, y), f = (u, v)
///     a = 1 - s,   s = (Σ p f - Σp Σf / n) / (Σ p² - (Σp)² / n),   (b, c) = s Σp / n - Σf / n
///
/// and once more without the pixels whose squared residual |f - s p + (b, c)|² is above outliers² times the first fit's mean: at
/// most 1 / outliers² of all. In float64, with x and y from the middle of the planes. A sum is that of four partial sums by x mod
/// 4, each row by row from the left, the first two plus the last two: so all machines give the same bits.
///
/// @param u, v float32 (h, w), pixels per frame, NaN where unknown, as pyramid_flow gives them
/// @param outliers multiple of the root mean square residual above which a pixel is left out of the second fit, finite, above 0
/// @param min_pixels pixels that each fit needs, at least 1
/// @throws std::invalid_argument on unlike shapes, or numbers out of range
/// Source: Umeyama 1991, equation (42) with R = 1, from the places now to those before; the second fit is one round of sigma
/// clipping.
FlowScale flow_scale(const PlaneView& u, const PlaneView& v, double outliers, int min_pixels);

}  // namespace tricue
