// SPDX-License-Identifier: MIT
#include "fuse/summarize.hpp"

#include "base/check.hpp"

namespace tricue {

namespace {

using Columns = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic>;

/// The weights divided by their sum.
Vector find_shares(StatesRef particles, VectorRef weights) {
    require_size(weights, particles.rows(), "weights");
    require_finite(particles, "particles");
    return weights / require_weights(weights);
}

Vector mean_of(const Columns& columns, const Vector& shares) {
    Vector mean(columns.cols());
    for (Eigen::Index d = 0; d < mean.size(); ++d) mean[d] = (shares * columns.col(d)).sum();
    return mean;
}

}  // namespace

Vector weighted_mean(StatesRef particles, VectorRef weights) {
    return mean_of(particles, find_shares(particles, weights));
}

Summary summarize(StatesRef particles, VectorRef weights) {
    const Vector shares = find_shares(particles, weights);
    const Eigen::Index dimensions = particles.cols();
    Columns centered = particles;
    Vector mean = mean_of(centered, shares);
    for (Eigen::Index d = 0; d < dimensions; ++d) centered.col(d) -= mean[d];
    // Around the mean, not as a difference of squares, which would lose all digits far from the origin.
    States covariance(dimensions, dimensions);
    for (Eigen::Index r = 0; r < dimensions; ++r)
        for (Eigen::Index c = r; c < dimensions; ++c)
            covariance(r, c) = covariance(c, r) = (shares * centered.col(r) * centered.col(c)).sum();
    return {std::move(mean), std::move(covariance), 1.0 / shares.square().sum()};
}

}  // namespace tricue
