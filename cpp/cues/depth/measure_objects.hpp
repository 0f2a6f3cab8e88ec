// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/depth/cut_sides.hpp"

namespace tricue {

/// The results of depth_components and cut_sides for C objects.
struct ObjectTable {
    /// float64 (C, 7), as depth_components gives it: x, y, width, height, area, pixels; depth, meters; label; all finite, sizes and
    /// depth above 0
    StatesRef table;
    FloatsRef columns, rows;  ///< float32 (C, bins): how an object's pixels are spread over its box, of sum 1
    Eigen::Ref<const Flags> cut;  ///< bool (C, 4): whether each may continue at the left, right, top, bottom
};

/// The floor that objects stand on.
struct Ground {
    VectorRef plane;  ///< float64 (4,): nx, ny, nz, d of the floor, meters; zeros where none is known
    /// the lower edge of an object that stands on the floor is less than this above it, meters, finite, at least 0
    double feet;
};

/// Segmented objects in meters: boxes at the depth of their objects, with the feet that were removed with the floor.
///
/// Pixel (u, v) at depth z is ((u - cx) z / fx, (v - cy) z / fy, z). An object that stands upright in front of a tilted camera
/// has one distance along the ground, f · X with f = e_z - nz n, rather than one depth. So the middle of a box's lower edge is at
/// X', where its ray has the distance of the box's center. If an object isn't cut there, and the height n · X' + d is above 0 and
/// less than `feet`, it stands on the floor, at X' - (n · X' + d) n: a strip down to the image of that point is added at its
/// lower edge, and taken to be filled like the rest of its box.
///
/// The centroid is the mean of the points of an object's pixels. With a floor, the parts of `rows` and the middle of the strip have
/// depths of one distance f · X, by which y counts, and the mean of the parts' depths is the object's.
///
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0; (0, 0) is the center of the first pixel
/// @returns float64 (C, 8): X, Y, Z of the box's center, Z being the object's mean depth, width, height; centroid minus that
///     center, x and y, all meters in the camera frame; area, m²
/// @throws std::invalid_argument on other shapes or values
/// Source: ours.
States measure_objects(const ObjectTable& objects, VectorRef camera, const Ground& ground);

}  // namespace tricue
