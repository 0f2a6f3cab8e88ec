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
TRICUE_INLINE double clamped(double z) {
    return std::min(std::max(z, -1e150), 1e150);
}

/// log(share e^ratio + 1 - share), ratio = log(detection / dynamics): the divisor of a likelihood. The larger term
/// is factored out of the logarithm.
double log_mixture(double ratio, double share) {
    const double greater = ratio > 0.0 ? share : 1.0 - share;
    const double smaller = ratio > 0.0 ? 1.0 - share : share;
    return std::max(ratio, 0.0) + std::log(greater + smaller * std::exp(-std::abs(ratio)));
}

constexpr Eigen::Index kBlock = 16;  ///< particles side by side, so that loops over them are vectorized

using Lanes = double[kBlock];

/// Squared distances of a block from the origin of N(0, root rootᵀ) in deviations, by forward substitution; z holds as many lanes as
/// there are numbers.
TRICUE_MULTIVERSION
void square_substituted(const Lanes* __restrict offset, const double* __restrict root, Eigen::Index size,
                        Lanes* __restrict z, double* __restrict squares) {
    for (Eigen::Index i = 0; i < kBlock; ++i) squares[i] = 0.0;
    for (Eigen::Index d = 0; d < size; ++d) {
        const double* row = root + d * size;
        Lanes rest;
        for (Eigen::Index i = 0; i < kBlock; ++i) rest[i] = clamped(offset[d][i]);
        for (Eigen::Index e = 0; e < d; ++e)
            for (Eigen::Index i = 0; i < kBlock; ++i) rest[i] -= clamped(row[e] * z[e][i]);
        for (Eigen::Index i = 0; i < kBlock; ++i) {
            z[d][i] = clamped(rest[i] / row[d]);
            squares[i] += z[d][i] * z[d][i];
        }
    }
}

/// The same of N(0, diag(scale²)).
TRICUE_MULTIVERSION
void square_scaled(const Lanes* __restrict offset, const double* __restrict scale, Eigen::Index size,
                   double* __restrict squares) {
    for (Eigen::Index i = 0; i < kBlock; ++i) squares[i] = 0.0;
    for (Eigen::Index d = 0; d < size; ++d)
        for (Eigen::Index i = 0; i < kBlock; ++i) {
            const double z = clamped(clamped(offset[d][i]) / scale[d]);
            squares[i] += z * z;
        }
}

void divide_by_mixture(StatesRef proposed, StatesRef previous, const Dynamics& dynamics,
                       const Detection& detection, Vector& log_weights) {
    const auto& [mean, root, share] = detection;
    const Eigen::Index size = mean.size();
    const Vector scale = dynamics.scale.head(size);
    const States factors = root;  // without gaps between its rows
    const double constants = scale.log().sum() - root.matrix().diagonal().array().log().sum();
    using Block = Eigen::Array<double, Eigen::Dynamic, kBlock, Eigen::RowMajor>;
    Block from_detection = Block::Zero(size, kBlock), from_dynamics = from_detection, z(size, kBlock);
    const auto lanes = [](Block& block) { return reinterpret_cast<Lanes*>(block.data()); };
    Lanes detected, moved;
    for (Eigen::Index first = 0; first < log_weights.size(); first += kBlock) {
        const Eigen::Index n = std::min(kBlock, log_weights.size() - first);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index d = 0; d < size; ++d) {
                from_detection(d, i) = proposed(first + i, d) - mean[d];
                from_dynamics(d, i) = proposed(first + i, d) - previous(first + i, d) - dynamics.drift[d];
            }
        square_substituted(lanes(from_detection), factors.data(), size, lanes(z), detected);
        square_scaled(lanes(from_dynamics), scale.data(), size, moved);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double ratio = -0.5 * detected[i] - -0.5 * moved[i] + constants;
            log_weights[first + i] -= log_mixture(ratio, share);
        }
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
