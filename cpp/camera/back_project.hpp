// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

struct BackProjection {
    States points;       ///< float64 (N, 3): x right, y down, z forward of the left camera, meters
    States covariances;  ///< float64 (N, 3, 3), meters²; in C++ each is a row of 9
};

/// Back-projects the measurements of a rectified stereo rig to points, with their covariances to first order:
///     z = fx b / d,  x = (u - cx) z / fx,  y = (v - cy) z / fy,  C = J S Jᵀ
///
/// J is the Jacobian of (x, y, z) with respect to (u, v, d), S the covariance of a measurement. A measurement that is not finite,
/// or whose d is not above 0, gives NaN.
///
/// @param measurements float64 (N, 3): u, v and d = u - u_right, pixels; (0, 0) is the center of the left image's first pixel
/// @param variances float64 (3,): those of u, v, d, independent, for all measurements; or (N, 3, 3): a covariance S for each;
///     pixels²
/// @param camera float64 (4,): fx, fy, cx, cy, pixels, fx and fy above 0
/// @param baseline b, meters
/// @throws std::invalid_argument on other shapes, a focal length or baseline that is not above 0, or invalid variances
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.2 and figure 2, which their (9) approximates.
BackProjection back_project(StatesRef measurements, StatesRef variances, VectorRef camera, double baseline);

}  // namespace tricue
