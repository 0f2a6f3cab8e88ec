// SPDX-License-Identifier: MIT
#include "fuse/detail/proposal.hpp"

#include "base/check.hpp"

namespace tricue {

void require_valid(const Dynamics& dynamics, Eigen::Index dimensions) {
    require_size(dynamics.drift, dimensions, "drift");
    require_size(dynamics.scale, dimensions, "scale");
    require_finite(dynamics.drift, "drift");
    require_finite(dynamics.scale, "scale");
    if (!(dynamics.scale >= 0.0).all()) refuse("scale", "no negative number", dynamics.scale.minCoeff());
}

void require_valid(const Detection& detection, Eigen::Index dimensions) {
    require_share(detection.share);
    const Eigen::Index size = detection.mean.size();
    if (size < 1 || size > dimensions)
        refuse("mean", "1 to " + std::to_string(dimensions) + " numbers", std::to_string(size));
    require_shape(detection.root, size, size, "root");
    if (detection.share == 0.0) return;
    require_finite(detection.mean, "mean");
    require_finite(detection.root, "root");
    const double smallest = detection.root.matrix().diagonal().minCoeff();
    if (!(smallest > 0.0)) refuse("root", "a diagonal above 0", smallest);
}

}  // namespace tricue
