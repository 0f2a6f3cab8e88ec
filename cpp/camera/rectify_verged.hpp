// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/image_view.hpp"

namespace tricue {

/// The bytes of an image, pixel by pixel, row by row.
using ImageBytes = Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>;

/// The right camera of a stereo pair, with the left one's intrinsics and its optical center on the left one's x axis.
struct VergedCamera {
    /// a, radians about y, above 0 where the camera is turned inwards, to the left; between -pi/2 and pi/2
    double angle;
    double focal;   ///< f = fx, pixels, finite, above 0; fy cancels out
    double cx, cy;  ///< principal point, pixels; (0, 0) is the center of the first pixel
};

/// Rectifies the right image of a verged stereo pair: as a camera parallel to the left one would see it.
///
/// A ray (x, y, f) of the parallel camera, in pixels from the principal point, maps to this pixel of the camera turned by a:
///     x_R = f (x cos a + f sin a) / (f cos a - x sin a)
///     y_R = f y / (f cos a - x sin a) = y (cos a + x_R sin a / f)                                     (8)
///
/// (8) is printed without its parentheses; y is y_L, as parallel cameras see a point in one row. With both equations the
/// disparity is f b / z - shift everywhere. With (8) alone (rows_only) epipolar lines are horizontal, but the disparity of one
/// depth varies across the image: by up to 0.085 f, besides the constant f tan a, with a of 10 degrees and a field of view of 60.
///
/// Pixels that only the verged camera sees lie left of column 0; a shift to the right keeps them. A shift of f tan a puts the
/// axis of the turned camera at the principal point. Sampling is bilinear, places rounded to 1/2048 pixel, values half up.
///
/// @param right uint8 (H, W) gray or (H, W, 3) BGR, at least one pixel, at most 1,048,575 rows and columns
/// @param center (cx, cy), the principal point, finite, pixels; (0, 0) is the center of the first pixel; None for the center of
///     the image
/// @param shift pixels by which the image moves to the right, finite
/// @param rows_only whether only the rows are rectified, by (8)
/// @returns uint8 of right's shape; black where the camera saw nothing
/// @throws std::invalid_argument on an image without pixels, or numbers out of range
/// Source: Okada, Shirai, Miura 1996, section 3.1 and figure 3.
ImageBytes rectify_verged(const ImageView& right, const VergedCamera& camera, double shift, bool rows_only);

}  // namespace tricue
