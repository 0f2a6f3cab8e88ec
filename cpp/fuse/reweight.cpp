// SPDX-License-Identifier: MIT
#include "fuse/reweight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// At 1e150 deviations the density is zero anyway, and the square is still finite.
inline double clamped(double z) {
    return std::min(std::max(z, -1e150), 1e150);
}

/// log(share e^ratio + 1 - share), ratio = log(detection / dynamics): the divisor of a likelihood. The larger term
/// is factored out of the logarithm.
double log_mixture(double ratio, double share) {
    const double greater = ratio > 0.0 ? share : 1.0 - share;
    const double smaller = ratio > 0.0 ? 1.0 - share : share;
    return std::max(ratio, 0.0) + std::log(greater + smaller * std::exp(-std::abs(ratio)));
}

/// One row for each number of the state that a detection measures, with a column for each particle.
using Rows = States;

/// For all particles at once: z = (offset - Σ factors[e] solved[e]) / divisor, whose squares are added up.
TRICUE_MULTIVERSION
void standardize(const double* offset, const double* solved, const double* factors, std::ptrdiff_t before,
                 double divisor, std::ptrdiff_t n, double* __restrict z, double* __restrict squares) {
    for (std::ptrdiff_t i = 0; i < n; ++i) z[i] = clamped(offset[i]);
    for (std::ptrdiff_t e = 0; e < before; ++e)
        for (std::ptrdiff_t i = 0; i < n; ++i) z[i] -= clamped(factors[e] * solved[n * e + i]);
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        z[i] = clamped(z[i] / divisor);
        squares[i] += z[i] * z[i];
    }
}

/// -2 times the log density of N(0, root rootᵀ) at the offsets by forward substitution, without its constants.
Vector squared_deviations(const Rows& offsets, StatesRef root) {
    const Eigen::Index n = offsets.cols();
    Vector squares = Vector::Zero(n);
    Rows z(offsets.rows(), n);
    for (Eigen::Index d = 0; d < offsets.rows(); ++d)
        standardize(offsets.row(d).data(), z.data(), root.row(d).data(), d, root(d, d), n, z.row(d).data(),
                    squares.data());
    return squares;
}

/// The same for N(0, diag(scale²)).
Vector squared_deviations(const Rows& offsets, const Vector& scale) {
    const Eigen::Index n = offsets.cols();
    Vector squares = Vector::Zero(n), z(n);
    for (Eigen::Index d = 0; d < offsets.rows(); ++d)
        standardize(offsets.row(d).data(), nullptr, nullptr, 0, scale[d], n, z.data(), squares.data());
    return squares;
}

void divide_by_mixture(StatesRef proposed, StatesRef previous, const Dynamics& dynamics,
                       const Detection& detection, Vector& log_weights) {
    const auto& [mean, root, share] = detection;
    const Eigen::Index size = mean.size(), n = log_weights.size();
    const Vector scale = dynamics.scale.head(size);
    const double constants = scale.log().sum() - root.matrix().diagonal().array().log().sum();
    Rows from_detection(size, n), from_dynamics(size, n);
    for (Eigen::Index d = 0; d < size; ++d)
        for (Eigen::Index i = 0; i < n; ++i) {
            from_detection(d, i) = proposed(i, d) - mean[d];
            from_dynamics(d, i) = proposed(i, d) - previous(i, d) - dynamics.drift[d];
        }
    const Vector detected = squared_deviations(from_detection, root);
    const Vector moved = squared_deviations(from_dynamics, scale);
    for (Eigen::Index i = 0; i < n; ++i)
        log_weights[i] -= log_mixture(-0.5 * detected[i] - -0.5 * moved[i] + constants, share);
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
