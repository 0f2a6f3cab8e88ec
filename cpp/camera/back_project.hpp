// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

struct BackProjection {
    States points;       ///< N x 3: x right, y down, z forward of the left camera, metres
    States covariances;  ///< N x 9, symmetric 3 x 3 matrices row by row, metres²
};

/// Points that a rectified stereo rig sees, with their covariances J S Jᵀ to first order:
///     z = fx b / d,  x = (u - cx) z / fx,  y = (v - cy) z / fy
///
/// @param measurements N x 3: u, v, d, pixels; (0, 0) is the centre of the first pixel of the left image, d = u - u_right
/// @param variances    1 x 3: those of u, v, d, independent, of all points; or N x 9, a covariance matrix each; pixels²
/// @param camera       4: fx, fy, cx, cy, pixels
/// @param baseline     b, metres
/// @returns            NaN for each measurement that isn't finite or whose d isn't above 0: nothing was measured there
/// @throws std::invalid_argument on other shapes, a focal length or baseline that isn't above 0, and variances that are none
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.2 and figure 2, which their (9) approximates.
BackProjection back_project(StatesRef measurements, StatesRef variances, VectorRef camera, double baseline);

}  // namespace tricue
