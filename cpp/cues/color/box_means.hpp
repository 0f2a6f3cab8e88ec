// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/plane_view.hpp"

namespace tricue {

/// Means of a map in boxes of N sizes round a place, over the areas that they have, outside the map lying 0.
///
/// Pixels count by the part that is covered. Two of them give what lies between two boxes, along a target's edge. Sums in
/// float64.
///
/// @param plane   H x W, finite, at least one pixel
/// @param x, y    the place, pixels from the map's corner, finite
/// @param widths  N, pixels, finite, above 0
/// @param heights N, pixels, finite, above 0
/// @throws std::invalid_argument on a plane without pixels, unlike sizes, and numbers out of range
/// Source: ours.
Vector box_means(const PlaneView& plane, double x, double y, VectorRef widths, VectorRef heights);

}  // namespace tricue
