// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/depth/cut_sides.hpp"

namespace tricue {

/// What depth_components and cut_sides tell of C objects.
struct ObjectTable {
    /// float64 (C, 7), as depth_components gives it: x, y, width, height, area, pixels; depth, meters; label; all finite, sizes and
    /// depth above 0
    StatesRef table;
    FloatsRef columns, rows;  ///< float32 (C, bins): how an object's pixels are spread over its box, of sum 1
    Eigen::Ref<const Flags> cut;  ///< bool (C, 4): whether it may go on at the left, right, top, bottom
};

/// Where objects stand.
struct Ground {
    VectorRef plane;  ///< float64 (4,): nx, ny, nz, d of the floor, meters; zeros where none is known
    /// greatest height of the lower edge of what stands on the floor, meters, finite, at least 0
    double feet;
    double legs;  ///< share of the width of its box that a body's legs fill, finite, at least 0
};

/// Segmented objects in meters: boxes at the depth of their objects, with the feet that were taken out with the floor.
///
/// Pixel (u, v) at depth z is ((u - cx) z / fx, (v - cy) z / fy, z). What stands upright before a tilted camera has one distance
/// along the ground, f · X with f = e_z - nz n, rather than one depth: the middle of a box's lower edge is where its ray has the
/// distance of the box's center, X'. An object that ends uncut, at a height n · X' + d less than `feet` above the floor, stands on
/// it, in X' - (n · X' + d) n: a strip down to where that is seen is added at its lower edge, and its centroid comes down by the
/// strip's share, legs x strip / height, of the area.
///
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0; (0, 0) is the center of the first pixel
/// @returns float64 (C, 8): X, Y, Z of the box's center, Z being the object's mean depth, width, height; centroid less that center,
///     x and y, all meters in the camera frame; area, m²
/// @throws std::invalid_argument on other shapes or values
/// Source: ours.
States measure_objects(const ObjectTable& objects, VectorRef camera, const Ground& ground);

}  // namespace tricue
