// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/plane_view.hpp"

namespace tricue {

/// Means of a map in N boxes of different sizes around one place.
///
/// A pixel counts by the part of it that is covered; outside the map the values are 0. Sums are float64. The means of two boxes
/// give what lies between them, along a target's edge.
///
/// @param plane float32 (H, W), finite, at least one pixel
/// @param x, y center of the boxes, finite, pixels from the map's top left corner
/// @param widths float64 (N,), finite, above 0, pixels
/// @param heights float64 (N,), finite, above 0, pixels
/// @returns float64 (N,)
/// @throws std::invalid_argument on a plane without pixels, unlike sizes, or numbers out of range
/// Source: ours.
Vector box_means(const PlaneView& plane, double x, double y, VectorRef widths, VectorRef heights);

}  // namespace tricue
