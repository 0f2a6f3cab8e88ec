// SPDX-License-Identifier: MIT
#include "cues/stereo/sad_disparity.hpp"

#include "cues/stereo/detail/cell_disparities.hpp"

namespace tricue {

Floats sad_disparity(const ImageView& left, const ImageView& right, const StereoRegion& region,
                     const DisparityRange& range, const StereoMatching& matching) {
    return cell_disparities({left, right, 1}, region, range, matching);
}

}  // namespace tricue
