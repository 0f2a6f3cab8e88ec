// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Height n · X + d above a plane of each pixel of a depth image.
///
/// In float32, in this order: h = z (nx x + (ny y + nz)) + d, with (x, y, 1) the ray ((u - cx) / fx, (v - cy) / fy, 1) in float64,
/// rounded to float32.
///
/// @param depth float32 (H, W), meters
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0
/// @param plane float64 (4,): nx, ny, nz, d in meters, camera frame (x right, y down, z forward), as floor_plane gives it; finite.
///     Where |n| is not 1, heights are |n| times as large
/// @returns float32 (H, W), meters; NaN where nothing was measured
/// @throws std::invalid_argument on an invalid camera or plane
/// Source: ours.
Floats height_above(const DepthView& depth, VectorRef camera, VectorRef plane);

}  // namespace tricue
