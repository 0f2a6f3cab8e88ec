// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/region.hpp"
#include "cues/depth/above_floor.hpp"
#include "cues/depth/fill_gaps.hpp"

namespace tricue {

/// How the share of the image on a known floor is measured, as in plane_support.
struct FloorTest {
    double tolerance;
    int step;
};

struct DepthForeground {
    Floats depth;     ///< float32 (h, w), meters, NaN in the background
    Vector support;   ///< float64 (2,), as plane_support gives it
    Region measured;  ///< (x0, y0, x1, y1), pixels: outside of it nothing was measured
};

/// The part of a frame in which a target can be: every step-th pixel of every step-th row, with gaps filled (fill_gaps), above
/// the floor and in range (above_floor). plane_support tells whether the floor is still there.
///
/// The measured rectangle leaves out the columns (or rows) at a side that have no depth even with gaps filled, as in registered
/// depth, if they are at most the share `margin` of all.
///
/// @param depth float32 (H, W), meters
/// @param step pixels, at least 1
/// @param gaps (gap, slope, max_gap_share, passes), as in fill_gaps
/// @param camera float64 (4,): fx, fy, cx, cy of the thinned image, pixels, fx and fy above 0
/// @param plane float64 (4,): the floor, as in above_floor; zeros for none
/// @param floor (tolerance, step), as in plane_support
/// @param space (near, far, clear), as in above_floor
/// @param margin in [0, 1]
/// @throws std::invalid_argument as those kernels
/// Source: ours.
DepthForeground find_foreground(const DepthView& depth, int step, const Gaps& gaps, VectorRef camera,
                                VectorRef plane, const FloorTest& floor, const Space& space, double margin);

}  // namespace tricue
