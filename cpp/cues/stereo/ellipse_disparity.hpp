// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/stereo/sad_disparity.hpp"

namespace tricue {

/// How the disparity of an ellipse is computed from those of its pixels.
struct DisparityStatistic {
    /// whether disparities keep their fractions; else each becomes the nearest whole number, of halves the smaller
    bool subpixel;
    bool median;      ///< whether it is their median, else it is their mean
    float tolerance;  ///< a pixel is near that disparity if it differs by at most this, pixels, 0 or more
};

struct EllipseDisparity {
    double disparity;  ///< pixels; NaN if no pixel has one
    int matched;       ///< pixels that have a disparity
    int near;          ///< of these, pixels that differ from it by at most the tolerance
};

/// The disparity of an ellipse: the median or the mean (5) of its pixels' disparities.
///
/// A pixel is inside if its center (column + 0.5, row + 0.5) is, as in ellipse_search. Pixels are matched by sad_disparity in the
/// images, which are first turned gray. Of an even number of disparities the median is the mean of the middle two.
///
/// @param left uint8 (H, W, 3) BGR, rectified, at least one pixel
/// @param right uint8 (H, W, 3) BGR, or gray (H, W), of the same size
/// @param ellipse float64 (4,): center x, y, semi-axes along x (minor) and y (major), pixels of the left image, finite, axes above 0
///     and at most 4096; may extend beyond the image
/// @throws std::invalid_argument on images of different sizes, or values out of range
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.2, equations (3) to (5); the median is ours.
EllipseDisparity ellipse_disparity(const ImageView& left, const ImageView& right, VectorRef ellipse,
                                   const DisparityRange& limits, const StereoMatching& matching,
                                   const DisparityStatistic& statistic);

}  // namespace tricue
