// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/ellipse_shape.hpp"
#include "base/image_view.hpp"
#include "cues/stereo/sad_disparity.hpp"

namespace tricue {

/// A rectified pair, BGR or gray, in cells of step x step pixels.
struct CellPair {
    const ImageView &left, &right;
    int step;
};

constexpr int kNoLeftRightCheck = -1;  ///< as its tolerance

/// The sad_disparity of the reduce_gray of both images, in cells. Only the compared cells are turned gray.
///
/// Throws std::invalid_argument like these two kernels.
Floats cell_disparities(const CellPair& pair, const StereoRegion& region, const DisparityRange& limits,
                        const StereoMatching& matching, int tolerance = kNoLeftRightCheck);

/// The same without that check for the cells of a shape, not empty, around a cell; NaN for the others of the rectangle around it.
Floats cell_disparities(const CellPair& pair, const EllipseShape& shape, const CenterPixel& center,
                        const DisparityRange& limits, const StereoMatching& matching);

}  // namespace tricue
