// SPDX-License-Identifier: MIT
#include "fuse/rank_filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "fuse/resample.hpp"
#include "fuse/reweight.hpp"
#include "fuse/summarize.hpp"

namespace tricue {
namespace {

constexpr double kMinWeight = 1e-300;  // lower bound of a weight before its logarithm is taken

void require_valid(const WeightedEllipses& last) {
    if (last.particles.rows() < 1) refuse("particles", "at least one", "none");
    require_shape(last.particles, last.particles.rows(), 4, "particles");
    require_size(last.weights, last.particles.rows(), "weights");
}

/// The particles that the filter starts from.
States chosen(const WeightedEllipses& last) {
    if (!last.offset) {
        require_weights(last.weights);
        return last.particles;
    }
    const Indices indices = resample(last.weights, *last.offset);
    States particles(last.particles.rows(), 4);
    for (Eigen::Index i = 0; i < particles.rows(); ++i)
        std::copy_n(last.particles.row(indices[i]).data(), 4, particles.row(i).data());
    return particles;
}

void add_logarithms(VectorRef weights, Vector& log_likelihood) {
    for (Eigen::Index i = 0; i < weights.size(); ++i)
        log_likelihood[i] += std::log(std::max(weights[i], kMinWeight));
}

/// The noise of both semi-axes mixed, with the same rounding as a matrix product.
States mixed(const EllipseNoise& noise, Eigen::Index N) {
    require_shape(noise.white, N, 4, "white");
    const double common = noise.correlation;
    if (!(std::abs(common) <= 1.0)) refuse("correlation", "a number in [-1, 1]", common);
    const double own = std::sqrt(1.0 - common * common);
    States numbers = noise.white;
    for (Eigen::Index i = 0; i < N; ++i) numbers(i, 3) = std::fma(numbers(i, 3), own, numbers(i, 2) * common);
    return numbers;
}

}  // namespace

FilteredEllipses rank_filter(const ImageView& image, const WeightedEllipses& last, const EllipseNoise& noise,
                             const Dynamics& dynamics, const Bounds& bounds, const Detection& detection,
                             const EllipsePattern& pattern, const ColorAppearance& appearance,
                             const LikelihoodFactors& factors, double flat) {
    require_valid(last);
    const States before = chosen(last);
    States moved = propose(before, dynamics, mixed(noise, before.rows()), detection, bounds);
    RankLikelihood likelihood(image, pattern, appearance, factors);
    Vector log_likelihood = likelihood.log_likelihood(moved);
    if (!last.offset) add_logarithms(last.weights, log_likelihood);
    Reweighted posterior = reweight(log_likelihood, moved, before, dynamics, detection);
    Summary summary = summarize(moved, posterior.weights);
    const Eigen::Map<const States> estimate(summary.mean.data(), 1, 4);
    const double its_own = likelihood.log_likelihood(estimate)[0];
    RankWindow window = likelihood.first_window(flat);
    return {std::move(moved),
            std::move(posterior.weights),
            summary.effective,
            std::move(summary.mean),
            its_own,
            std::move(window.ranks),
            std::move(window.correlations)};
}

}  // namespace tricue
