// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Height above a plane of all that a depth image shows: n · X + d, NaN where nothing was measured.
///
/// In float32, in this order: h = z (nx x + (ny y + nz)) + d, where (x, y, 1) is the ray of the pixel, (u - cx) / fx
/// and (v - cy) / fy in float64, rounded to float32.
///
/// @param depth  metres
/// @param camera (4,): fx, fy above 0, cx, cy, pixels
/// @param plane  (4,): nx, ny, nz, d in metres, camera frame (x right, y down, z forward), as floor_plane gives it; finite.
///               Where |n| isn't 1, heights are |n| times as large
/// @returns      (H, W) metres
/// @throws std::invalid_argument on a camera or plane that is none
/// Source: ours.
Floats height_above(const DepthView& depth, VectorRef camera, VectorRef plane);

}  // namespace tricue
