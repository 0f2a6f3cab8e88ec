// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/depth/cut_sides.hpp"

namespace tricue {

/// What depth_components tells of C objects, and cut_sides.
struct ObjectTable {
    StatesRef table;              ///< (C, 7): x, y, width, height, area, pixels; depth, metres; label
    FloatsRef columns, rows;      ///< (C, bins) each: how its pixels are spread over its box
    Eigen::Ref<const Flags> cut;  ///< (C, 4)
};

/// Where objects stand: the plane (4,) of the floor, n, d, all 0 where none is known; what ends, uncut, less than `feet` metres
/// above it stands on it, and a body's legs are `legs` as wide as its box.
struct Ground {
    VectorRef plane;
    double feet, legs;
};

/// Segmented objects in metres: boxes at their objects' depth, with the feet that were taken out with the floor.
///
/// Pixel (u, v) at depth z is ((u - cx) z / fx, (v - cy) z / fy, z). The height of a box's lower edge is that of its middle,
/// (n · X + d) / max(-ny, 0.1), along the camera's y axis. An object that stands on the floor gets a strip of that height
/// added at its lower edge, and its centroid comes down by the strip's share, legs x strip / height, of the area.
///
/// @param objects all finite; widths, heights and depths above 0
/// @param camera  (4,): fx, fy above 0, cx, cy, pixels, (0, 0) is the centre of the first
/// @returns       (C, 8): X, Y, Z of the box's centre, Z being the object's mean depth, width, height; from that centre to the
///                centroid, x and y; area: metres, camera frame, and square metres
/// @throws std::invalid_argument on an argument that isn't what is said here
/// Source: ours.
States measure_objects(const ObjectTable& objects, VectorRef camera, const Ground& ground);

}  // namespace tricue
