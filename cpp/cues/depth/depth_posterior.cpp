// SPDX-License-Identifier: MIT
#include "cues/depth/depth_posterior.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/read_grid.hpp"

namespace tricue {
namespace {

constexpr float kClutter = 0.1F;
constexpr float kMaxExponent = 80.0F;  // of a posterior below 1e-33; more would overflow

inline bool is_measured(float z) {
    return z > 0.0F && z <= std::numeric_limits<float>::max();
}

/// exp(x) for x from 0 to kMaxExponent: 2^k times Cephes' polynomial of the remainder, at most ln(2) / 2. Vectorizable with every
/// instruction set.
inline float exp_positive(float x) {
    const auto k = static_cast<std::int32_t>(x * 1.44269504F + 0.5F);
    const auto whole = static_cast<float>(k);
    const float r = whole * 2.12194440e-4F + (whole * -0.693359375F + x);  // ln 2 in two parts
    const float low = (4.1665795894e-2F * r + 1.6666665459e-1F) * r + 5.0000001201e-1F;
    const float high = (1.9875691500e-4F * r + 1.3981999507e-3F) * r + 8.3334519073e-3F;
    const float r2 = r * r, series = (high * (r2 * r) + low) * r2 + (r + 1.0F);
    const std::int32_t bits = (k + 127) << 23;
    float power;
    std::memcpy(&power, &bits, sizeof power);
    return series * power;
}

/// The posteriors 1 / (1 + c / p), 1/2 where nothing is measured, and whether it is nearer than `near`.
TRICUE_MULTIVERSION
void judge(const float* __restrict depths, double expected, double per_sigma, double near, Eigen::Index n,
           float* __restrict posterior, std::uint8_t* __restrict nearer) {
    for (Eigen::Index i = 0; i < n; ++i) {
        const bool measured = is_measured(depths[i]);
        const double z = measured ? static_cast<double>(depths[i]) : expected;
        const double deviation = (z - expected) * per_sigma;
        const auto exponent = static_cast<float>(0.5 * deviation * deviation);
        const float inverse = exp_positive(exponent < kMaxExponent ? exponent : kMaxExponent);
        const float share = 1.0F / (1.0F + kClutter * inverse);
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
