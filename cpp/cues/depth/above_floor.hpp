// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"

namespace tricue {

/// Where a target may be: depths in [near, far), metres, and higher than `clear` above the floor.
struct Space {
    double near, far, clear;
};

/// The part of a depth image in which a target can be: its own depth there, NaN elsewhere.
///
/// Heights are height_above's, in float32; near, far and clear are rounded to it.
///
/// @param depth  metres
/// @param camera (4,): fx, fy above 0, cx, cy, pixels
/// @param plane  (4,): the floor nx, ny, nz, d, finite; all 0 where none is known: then everything is above it
/// @param space  0 <= near < far, finite; clear finite
/// @returns      (H, W) metres
/// @throws std::invalid_argument on a camera, plane or space that is none
/// Source: ours.
Floats above_floor(const DepthView& depth, VectorRef camera, VectorRef plane, const Space& space);

}  // namespace tricue
