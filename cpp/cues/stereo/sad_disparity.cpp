// SPDX-License-Identifier: MIT
#include "cues/stereo/sad_disparity.hpp"

#include "cues/stereo/detail/cell_disparities.hpp"

namespace tricue {

Floats sad_disparity(const ImageView& left, const ImageView& right, const StereoRegion& region,
                     const DisparityRange& limits, const StereoMatching& matching, int tolerance) {
    return cell_disparities({left, right, 1}, region, limits, matching, tolerance);
}

}  // namespace tricue
