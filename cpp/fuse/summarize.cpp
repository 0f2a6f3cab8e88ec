// SPDX-License-Identifier: MIT
#include "fuse/summarize.hpp"

#include "base/check.hpp"

namespace tricue {

using Columns = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic>;

Summary summarize(StatesRef particles, VectorRef weights) {
    require_size(weights, particles.rows(), "weights");
    require_finite(particles, "particles");
    const Vector shares = weights / require_weights(weights);
    const Eigen::Index dimensions = particles.cols();

    Columns centered = particles;
    Vector mean(dimensions);
    for (Eigen::Index d = 0; d < dimensions; ++d) {
        mean[d] = (shares * centered.col(d)).sum();
        centered.col(d) -= mean[d];
    }
    // Around the mean, not as a difference of squares, which would lose all digits far from the origin.
    States covariance(dimensions, dimensions);
    for (Eigen::Index r = 0; r < dimensions; ++r)
        for (Eigen::Index c = r; c < dimensions; ++c)
            covariance(r, c) = covariance(c, r) = (shares * centered.col(r) * centered.col(c)).sum();
    return {std::move(mean), std::move(covariance), 1.0 / shares.square().sum()};
}

}  // namespace tricue
