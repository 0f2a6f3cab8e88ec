// SPDX-License-Identifier: MIT
#include "fuse/reweight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check.hpp"

namespace tricue {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// At 1e150 deviations a density is zero all the same, and the square is still finite.
template <typename Values>
auto bounded(const Values& z) {
    return z.max(-1e150).min(1e150);
}

/// A zero-mean Gaussian in the plane with the root (xx 0; yx yy); the constant -log 2π is left out.
Vector log_density(const Vector& x, const Vector& y, double xx, double yx, double yy) {
    const Vector u = bounded(bounded(x) / xx);
    const Vector v = bounded((bounded(y) - bounded(yx * u)) / yy);
    return -0.5 * (u.square() + v.square()) - (std::log(xx) + std::log(yy));
}

/// log(share e^ratio + 1 - share), ratio = log(detection / dynamics): what the mixture divides a likelihood by. The greater
/// of both terms is taken out of the logarithm.
double log_mixture(double ratio, double share) {
    const double greater = ratio > 0.0 ? share : 1.0 - share;
    const double smaller = ratio > 0.0 ? 1.0 - share : share;
    return std::max(ratio, 0.0) + std::log(greater + smaller * std::exp(-std::abs(ratio)));
}

void divide_by_mixture(StatesRef proposed, StatesRef previous, const Dynamics& dynamics,
                       const Detection& detection, Vector& log_weights) {
    const auto& [drift, scale] = dynamics;
    const auto& [mean, root, share] = detection;
    const Vector x = proposed.col(0), y = proposed.col(1);
    const Vector ratio =
        log_density(x - mean[0], y - mean[1], root(0, 0), root(1, 0), root(1, 1)) -
        log_density(x - previous.col(0) - drift[0], y - previous.col(1) - drift[1], scale[0], 0.0, scale[1]);
    for (Eigen::Index i = 0; i < log_weights.size(); ++i) log_weights[i] -= log_mixture(ratio[i], share);
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
    if (proposed.cols() < 2) refuse("proposed", "states of 2 or more numbers", double(proposed.cols()));
    require_valid(log_likelihood);
    require_size(log_likelihood, proposed.rows(), "log_likelihood");
    require_shape(previous, proposed.rows(), proposed.cols(), "previous");
    require_finite(proposed, "proposed");
    require_finite(previous, "previous");
    require_valid(dynamics, proposed.cols());
    require_valid(detection);

    Vector log_weights = log_likelihood;
    if (detection.share > 0.0) {
        const double smallest = std::min(dynamics.scale[0], dynamics.scale[1]);
        if (!(smallest > 0.0)) refuse("scale", "numbers above 0 for the position", smallest);
        divide_by_mixture(proposed, previous, dynamics, detection, log_weights);
    }
    return normalized(std::move(log_weights));
}

}  // namespace tricue
