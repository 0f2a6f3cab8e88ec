// SPDX-License-Identifier: MIT
#include "fuse/rank_filter.hpp"

#include <utility>

#include "base/check.hpp"
#include "fuse/reweight.hpp"
#include "fuse/summarize.hpp"

namespace tricue {
namespace {

void require_valid(const WeightedEllipses& last) {
    if (last.particles.rows() < 1) refuse("particles", "at least one", "none");
    require_shape(last.particles, last.particles.rows(), 4, "particles");
    require_size(last.log_weights, last.particles.rows(), "log_weights");
    for (const double each : last.log_weights)
        if (!(each <= 0.0)) refuse("log_weights", "numbers up to 0", each);
}

}  // namespace

FilteredEllipses rank_filter(const ImageView& image, const WeightedEllipses& last, StatesRef noise,
                             const Dynamics& dynamics, const Bounds& bounds, const Detection& detection,
                             const Windows& windows, const ColorLook& look, const LookWeights& weights) {
    require_valid(last);
    States moved = propose(last.particles, dynamics, noise, detection, bounds);
    const Vector log_likelihood = rank_likelihood(image, moved, windows, look, weights) + last.log_weights;
    Reweighted posterior = reweight(log_likelihood, moved, last.particles, dynamics, detection);
    Summary summary = summarize(moved, posterior.weights);
    const Eigen::Map<const States> estimate(summary.mean.data(), 1, 4);
    const double its_own = rank_likelihood(image, estimate, windows, look, weights)[0];
    return {std::move(moved), std::move(posterior.weights), summary.effective, std::move(summary.mean),
            its_own};
}

}  // namespace tricue
