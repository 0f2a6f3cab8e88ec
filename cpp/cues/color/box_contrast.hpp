// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/plane_view.hpp"

namespace tricue {

/// A box and the frame around it.
struct FramedBox {
    double width, height;  ///< of the box, pixels, finite, above 0
    double outer;          ///< size of the frame's outer edge relative to the box, finite, above 1
};

/// Center-surround contrast of a map: its mean in a box minus `around` times its mean in the frame around the box.
///
/// Output (i, j) is for the box centered at x = C + 2 (j - C // 2), y = R + 2 (i - R // 2), so the middle output is for the
/// middle of the map. A pixel counts by its covered fraction; outside the map the values are 0. Sums are float64.
///
/// @param plane float32 (2R, 2C), finite, at least 2 x 2
/// @param around weight of the frame, finite
/// @returns float32 (R, C)
/// @throws std::invalid_argument on a plane with an odd side or without pixels, or numbers out of range
/// Source: ours; centers and surrounds by integral images, after Viola, Jones 2001.
Floats box_contrast(const PlaneView& plane, const FramedBox& box, double around);

}  // namespace tricue
