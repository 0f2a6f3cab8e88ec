// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/image_view.hpp"

namespace tricue {

/// The bytes of an image, pixel by pixel, row by row.
using ImageBytes = Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>;

/// The right camera of a rig, of the left one's intrinsics, its optical centre on the left one's x-axis.
struct VergedCamera {
    double
        angle;  ///< radians about y, above 0 where it is turned inwards, to the left; between -pi/2 and pi/2
    double focal;   ///< fx, pixels; fy cancels out
    double cx, cy;  ///< principal point, pixels; (0, 0) is the centre of the first pixel
};

/// Equation (8): the image of a right camera turned by a about y, as the camera that is parallel to the left one would see it.
///
/// A ray (x, y, f) of the parallel camera, pixels from the principal point, is (x cos a + f sin a, y, f cos a - x sin a) in the
/// turned one, so
///     x_R = f (x cos a + f sin a) / (f cos a - x sin a),   y_R = f y / (f cos a - x sin a) = y (cos a + x_R sin a / f)
/// The latter is (8), which is printed without its parentheses; y is y_L, as parallel cameras see a point in one row.
///
/// Rows and columns are turned back: only then is the disparity f b / z wherever a point is, which positions and one disparity
/// for a flat target need. Of (8) alone, `rows_only`, the epipolar lines are as horizontal, but one depth has not one x_L - x_R:
/// beside f tan a it changes by up to 0.085 f across the image (10 degrees, 60 of view), which is 47 of 640 pixels.
///
/// What a verged camera sees in addition lies left of column 0. A `shift` moves the picture to the right to keep that:
/// disparities are then f b / z - shift; f tan a puts the turned camera's axis into the principal point.
///
/// @param right gray or BGR
/// @returns     as many pixels, packed; bilinear, places to 1/2048 px, rounded half up; black where the camera saw nothing
/// @throws std::invalid_argument on an image without pixels and on numbers out of range
/// Source: Okada, Shirai, Miura 1996, section 3.1 and figure 3.
ImageBytes rectify_verged(const ImageView& right, const VergedCamera& camera, double shift, bool rows_only);

}  // namespace tricue
