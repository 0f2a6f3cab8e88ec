// SPDX-License-Identifier: MIT
#include "fuse/propose.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"

namespace tricue {
namespace {

void require_valid(const Bounds& bounds, Eigen::Index dimensions) {
    require_size(bounds.lower, dimensions, "lower");
    require_size(bounds.upper, dimensions, "upper");
    for (Eigen::Index d = 0; d < dimensions; ++d)
        if (!(bounds.lower[d] <= bounds.upper[d])) refuse("lower", "no number above upper", bounds.lower[d]);
}

void move(StatesRef particles, const Dynamics& dynamics, StatesRef noise, States& moved) {
    for (Eigen::Index i = 0; i < moved.rows(); ++i)
        for (Eigen::Index d = 0; d < moved.cols(); ++d)
            moved(i, d) = particles(i, d) + dynamics.drift[d] + dynamics.scale[d] * noise(i, d);
}

/// Whether the share's running total passes a whole number here.
bool detected(Eigen::Index i, double share) {
    return std::floor(static_cast<double>(i + 1) * share) > std::floor(static_cast<double>(i) * share);
}

void detect(const Detection& detection, StatesRef noise, States& moved) {
    for (Eigen::Index i = 0; i < moved.rows(); ++i) {
        if (!detected(i, detection.share)) continue;
        for (Eigen::Index d = 0; d < detection.mean.size(); ++d) {
            moved(i, d) = detection.mean[d];
            for (Eigen::Index e = 0; e <= d; ++e) moved(i, d) += detection.root(d, e) * noise(i, e);
        }
    }
}

void clamp(const Bounds& bounds, States& moved) {
    for (Eigen::Index i = 0; i < moved.rows(); ++i)
        for (Eigen::Index d = 0; d < moved.cols(); ++d)
            moved(i, d) = std::min(std::max(bounds.lower[d], moved(i, d)), bounds.upper[d]);
}

}  // namespace

States propose(StatesRef particles, const Dynamics& dynamics, StatesRef noise, const Detection& detection,
               const Bounds& bounds) {
    require_shape(noise, particles.rows(), particles.cols(), "noise");
    require_finite(particles, "particles");
    require_finite(noise, "noise");
    require_valid(dynamics, particles.cols());
    require_valid(detection, particles.cols());
    require_valid(bounds, particles.cols());

    States moved(particles.rows(), particles.cols());
    move(particles, dynamics, noise, moved);
    detect(detection, noise, moved);
    clamp(bounds, moved);
    return moved;
}

}  // namespace tricue
