// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// What a target's depths are like: a histogram of depth relative to the target's own, L levels of [-reach, reach) metres.
struct DepthModel {
    VectorRef histogram;
    double reach;
};

/// How far what each rectangle shows is from the model, how much of it is at the rectangle's depth, and how much before it.
///
/// The same n places of every rectangle are read: (floor(y + height / 2 v), floor(x + width / 2 u)) for each (u, v) of the
/// pattern, in float64; pixel (0, 0) covers [0, 1) x [0, 1). A place outside the image, or without a measurement, is unseen. A
/// depth counts where its level floor(((depth - z) + reach) (L / (2 reach))), in float64, is in [0, L). The histogram h of
/// what counts is divided by its number; (38) on histograms of sum 1 reaches sqrt 2, by which it is divided.
///
/// @param depth      metres; may be empty
/// @param rectangles (N, 5): centre x, y, width, height, pixels; depth z, metres; finite
/// @param model      histogram (L,) of sum 1, or all 0, none negative; reach above 0, finite
/// @param pattern    (n, 2): (u, v), 1 being the right and the lower edge; finite, n at least 1
/// @param nearer     metres, finite, not negative
/// @returns          (N, 3): sqrt(sum (h - m)²) / sqrt 2, in [0, 1], 1 where nothing counts; the share of the places that
///                   count; the share of the places whose depth is below z - nearer
/// @throws std::invalid_argument on other shapes or values
/// Source: Sabeti, Parvizi, Wu 2008, equation (38), section IV.B; depth relative to z, and what is nearer, are ours.
States depth_distance(const DepthView& depth, StatesRef rectangles, const DepthModel& model,
                      StatesRef pattern, double nearer);

}  // namespace tricue
