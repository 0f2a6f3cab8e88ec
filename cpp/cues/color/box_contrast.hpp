// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/plane_view.hpp"

namespace tricue {

/// A box and its surround, the frame between the box and a scaled one.
struct SurroundedBox {
    double width, height;  ///< of the box, pixels, finite, above 0
    double surround_size;  ///< size of the surround's outer edge relative to the box, finite, above 1
};

/// Center-surround contrast of a map: its mean in a box minus `surround_weight` times its mean in the frame
/// around the box, whose outer size is `surround_size` times the box's.
///
/// Output (i, j) is for the box centered at x = C + 2 (j - C // 2), y = R + 2 (i - R // 2), so the middle output is for the
/// middle of the map. A pixel counts by its covered fraction; outside the map the values are 0. Sums are float64.
///
/// @param plane float32 (2R, 2C), finite, at least 2 x 2
/// @param surround_weight finite
/// @returns float32 (R, C)
/// @throws std::invalid_argument on a plane with an odd side or without pixels, or numbers out of range
/// Source: ours; centers and surrounds by integral images, after Viola, Jones 2001.
Floats box_contrast(const PlaneView& plane, const SurroundedBox& box, double surround_weight);

}  // namespace tricue
