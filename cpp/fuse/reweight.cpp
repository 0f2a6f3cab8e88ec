// SPDX-License-Identifier: MIT
#include "fuse/reweight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"

namespace tricue {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// At 1e150 deviations the density is zero anyway, and the square is still finite.
double clamped(double z) {
    return std::min(std::max(z, -1e150), 1e150);
}

/// log(share e^ratio + 1 - share), ratio = log(detection / dynamics): the divisor of a likelihood. The larger term
/// is factored out of the logarithm.
double log_mixture(double ratio, double share) {
    const double greater = ratio > 0.0 ? share : 1.0 - share;
    const double smaller = ratio > 0.0 ? 1.0 - share : share;
    return std::max(ratio, 0.0) + std::log(greater + smaller * std::exp(-std::abs(ratio)));
}

/// Log density of N(0, root rootᵀ) at the offset by forward substitution, without its constants; z holds K numbers.
double log_density(const double* offset, StatesRef root, double* z) {
    double squares = 0.0;
    for (Eigen::Index d = 0; d < root.rows(); ++d) {
        double rest = clamped(offset[d]);
        for (Eigen::Index e = 0; e < d; ++e) rest -= clamped(root(d, e) * z[e]);
        z[d] = clamped(rest / root(d, d));
        squares += z[d] * z[d];
    }
    return -0.5 * squares;
}

/// The same of N(0, diag(scale²)).
double log_density(const double* offset, VectorRef scale) {
    double squares = 0.0;
    for (Eigen::Index d = 0; d < scale.size(); ++d) {
        const double z = clamped(clamped(offset[d]) / scale[d]);
        squares += z * z;
    }
    return -0.5 * squares;
}

void divide_by_mixture(StatesRef proposed, StatesRef previous, const Dynamics& dynamics,
                       const Detection& detection, Vector& log_weights) {
    const auto& [mean, root, share] = detection;
    const Eigen::Index size = mean.size();
    const Vector drift = dynamics.drift.head(size), scale = dynamics.scale.head(size);
    const double constants = scale.log().sum() - root.matrix().diagonal().array().log().sum();
    Vector from_detection(size), from_dynamics(size), z(size);
    for (Eigen::Index i = 0; i < log_weights.size(); ++i) {
        for (Eigen::Index d = 0; d < size; ++d) {
            from_detection[d] = proposed(i, d) - mean[d];
            from_dynamics[d] = proposed(i, d) - previous(i, d) - drift[d];
        }
        const double ratio = log_density(from_detection.data(), root, z.data()) -
                             log_density(from_dynamics.data(), scale) + constants;
        log_weights[i] -= log_mixture(ratio, share);
    }
}

/// Equation (31) by log-sum-exp.
Reweighted normalized(Vector log_weights) {
    const auto count = static_cast<double>(log_weights.size());
    const double greatest = log_weights.maxCoeff();
    if (greatest == -kInfinity) return {Vector::Constant(log_weights.size(), 1.0 / count), -kInfinity};
    for (double& weight : log_weights) weight = std::exp(weight - greatest);
    const double total = log_weights.sum();
    log_weights /= total;
    return {std::move(log_weights), greatest + std::log(total / count)};
}

void require_valid(VectorRef log_likelihood) {
    if (log_likelihood.size() == 0) refuse("log_likelihood", "at least one particle", "none");
    for (Eigen::Index i = 0; i < log_likelihood.size(); ++i)
        if (!(log_likelihood[i] < kInfinity))
            refuse("log_likelihood", "numbers below infinity", log_likelihood[i]);
}

}  // namespace

Reweighted reweight(VectorRef log_likelihood, StatesRef proposed, StatesRef previous,
                    const Dynamics& dynamics, const Detection& detection) {
    require_valid(log_likelihood);
    require_size(log_likelihood, proposed.rows(), "log_likelihood");
    require_shape(previous, proposed.rows(), proposed.cols(), "previous");
    require_finite(proposed, "proposed");
    require_finite(previous, "previous");
    require_valid(dynamics, proposed.cols());
    require_valid(detection, proposed.cols());

    Vector log_weights = log_likelihood;
    if (detection.share > 0.0) {
        const double smallest = dynamics.scale.head(detection.mean.size()).minCoeff();
        if (!(smallest > 0.0)) refuse("scale", "numbers above 0 where the mean has some", smallest);
        divide_by_mixture(proposed, previous, dynamics, detection, log_weights);
    }
    return normalized(std::move(log_weights));
}

}  // namespace tricue
