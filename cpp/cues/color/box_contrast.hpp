// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/plane_view.hpp"

namespace tricue {

/// A box and the frame round it.
struct FramedBox {
    double width, height;  ///< pixels, finite, above 0
    double outer;          ///< the frame's outer size in the box's, finite, above 1
};

/// How much more of a map lies in a box than round it, for every second place of the box.
///
/// The mean in the box minus `around` times that in the frame, means over the areas that they have, outside the map lying 0. The value in
/// row i, column j of R x C is for a box with its centre at (C + 2 (j - C / 2), R + 2 (i - R / 2)), with whole divisions: so the
/// middle one is in the middle. Pixels count by the part that is covered. Sums in float64.
///
/// @param plane  2 R x 2 C, finite; at least 2 x 2
/// @param around finite
/// @returns      R x C
/// @throws std::invalid_argument on a plane with an odd side or without pixels, and on numbers out of range
/// Source: ours; centre-surround contrast, as Viola and Jones's integral images give it.
Floats box_contrast(const PlaneView& plane, const FramedBox& box, double around);

}  // namespace tricue
