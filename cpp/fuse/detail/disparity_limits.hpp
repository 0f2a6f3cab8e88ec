// SPDX-License-Identifier: MIT
#pragma once

namespace tricue {

/// Which disparities are similar to the target's, and which an occluder's.
struct DisparityLimits {
    double target;     ///< the target's disparity, pixels
    double tolerance;  ///< similar ones differ by at most this from the target's, pixels
    double occluder;   ///< those above this are an occluder's, pixels
};

}  // namespace tricue
