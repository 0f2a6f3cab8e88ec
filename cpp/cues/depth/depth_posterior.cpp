// SPDX-License-Identifier: MIT
#include "cues/depth/depth_posterior.hpp"

#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/exp_negative.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/read_grid.hpp"

namespace tricue {
namespace {

constexpr float kClutter = 0.1F;

inline bool is_measured(float z) {
    return z > 0.0F && z <= std::numeric_limits<float>::max();
}

/// The posteriors p / (p + c), 1/2 where nothing is measured, and whether it is nearer than `near`.
TRICUE_MULTIVERSION
void judge(const float* __restrict depths, double expected, double per_sigma, double near, Eigen::Index n,
           float* __restrict posterior, std::uint8_t* __restrict nearer) {
    for (Eigen::Index i = 0; i < n; ++i) {
        const bool measured = is_measured(depths[i]);
        const double z = measured ? static_cast<double>(depths[i]) : expected;
        const double deviation = (z - expected) * per_sigma;
        const float likelihood = exp_negative(static_cast<float>(-0.5 * deviation * deviation));
        const float share = likelihood / (likelihood + kClutter);
        posterior[i] = measured ? share : 0.5F;
        nearer[i] = z < near;
    }
}

void require_positive(double number, const char* name) {
    if (!(number > 0.0 && std::isfinite(number))) refuse(name, "a finite number above 0", number);
}

void require_arguments(const SampleGrid& grid, const ExpectedDepth& target) {
    require_grid(grid);
    require_positive(target.expected, "expected");
    require_positive(target.sigma, "sigma");
    if (!(target.near_margin >= 0.0 && std::isfinite(target.near_margin)))
        refuse("near_margin", "a finite number, not negative", target.near_margin);
}

}  // namespace

DepthPosterior depth_posterior(const DepthView& depth, const SampleGrid& grid, const ExpectedDepth& target) {
    require_arguments(grid, target);
    const Floats depths = read_grid(depth, grid);
    DepthPosterior result{Floats(grid.rows, grid.columns), {}};
    result.nearer.resize(grid.rows, grid.columns);
    judge(depths.data(), target.expected, 1.0 / target.sigma, target.expected - target.near_margin,
          depths.size(), result.posterior.data(), result.nearer.data());
    return result;
}

}  // namespace tricue
