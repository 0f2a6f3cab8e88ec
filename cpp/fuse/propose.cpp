// SPDX-License-Identifier: MIT
#include "fuse/propose.hpp"

#include <algorithm>
#include <cstdint>

#include "base/check.hpp"

namespace tricue {
namespace {

void require_valid(const Bounds& bounds, Eigen::Index dimensions) {
    require_size(bounds.lower, dimensions, "lower");
    require_size(bounds.upper, dimensions, "upper");
    for (Eigen::Index d = 0; d < dimensions; ++d)
        if (!(bounds.lower[d] <= bounds.upper[d])) refuse("lower", "no number above upper", bounds.lower[d]);
}

/// Whether the share's running total passes a whole number here.
bool is_detected(Eigen::Index i, double share) {
    const auto whole = [share](Eigen::Index count) {
        return static_cast<std::int64_t>(static_cast<double>(count) * share);
    };
    return whole(i + 1) > whole(i);
}

void move(const double* from, const Dynamics& dynamics, const double* noise, double* to) {
    for (Eigen::Index d = 0; d < dynamics.drift.size(); ++d)
        to[d] = from[d] + dynamics.drift[d] + dynamics.scale[d] * noise[d];
}

void draw_detected(const Detection& detection, const double* noise, double* to) {
    for (Eigen::Index d = 0; d < detection.mean.size(); ++d) {
        to[d] = detection.mean[d];
        for (Eigen::Index e = 0; e <= d; ++e) to[d] += detection.root(d, e) * noise[e];
    }
}

void clamp(const Bounds& bounds, double* state) {
    for (Eigen::Index d = 0; d < bounds.lower.size(); ++d)
        state[d] = std::min(std::max(bounds.lower[d], state[d]), bounds.upper[d]);
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
    for (Eigen::Index i = 0; i < moved.rows(); ++i) {
        double* state = moved.row(i).data();
        const double* numbers = noise.row(i).data();
        move(particles.row(i).data(), dynamics, numbers, state);
        if (is_detected(i, detection.share)) draw_detected(detection, numbers, state);
        clamp(bounds, state);
    }
    return moved;
}

}  // namespace tricue
