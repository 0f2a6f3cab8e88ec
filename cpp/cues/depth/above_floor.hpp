// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Where a target may be.
struct Space {
    double near, far;  ///< range of depth [near, far), meters, 0 <= near < far, finite
    double clear;      ///< height above the floor, meters, finite
};

/// The part of a depth image in which a target can be: the depth z where near <= z < far and the pixel is higher than `clear` above
/// the floor.
///
/// Heights n · X + d are in float32, to which near, far and clear are rounded.
///
/// @param depth float32 (H, W), meters
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0
/// @param plane float64 (4,): the floor nx, ny, nz, d in meters, as floor_plane gives it, finite; zeros for none: then everything
///     is above it
/// @returns float32 (H, W), meters; NaN elsewhere
/// @throws std::invalid_argument on an invalid camera, plane, range or clear
/// Source: ours.
Floats above_floor(const DepthView& depth, VectorRef camera, VectorRef plane, const Space& space);

}  // namespace tricue
