// SPDX-License-Identifier: MIT
#include "cues/depth/depth_posterior.hpp"

#include <cstring>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/read_grid.hpp"

namespace tricue {
namespace {

constexpr float kClutter = 0.1F;
constexpr float kMaxExponent = 80.0F;  // there the posterior is below 1e-33; larger exponents would overflow

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

/// ((z - expected) / sigma)² / 2 where depth is measured, else 0; and whether it is nearer than `near`.
TRICUE_MULTIVERSION
void measure_deviations(const float* __restrict depths, double expected, double per_sigma, double near,
                        Eigen::Index n, float* __restrict exponents, std::uint8_t* __restrict nearer) {
    for (Eigen::Index i = 0; i < n; ++i) {
        const bool measured = has_depth(depths[i]);
        const double z = measured ? static_cast<double>(depths[i]) : expected;
        const double deviation = (z - expected) * per_sigma;
        const auto exponent = static_cast<float>(0.5 * deviation * deviation);
        exponents[i] = exponent < kMaxExponent ? exponent : kMaxExponent;
        nearer[i] = z < near;
    }
}

TRICUE_MULTIVERSION
void replace_by_exponentials(float* numbers, Eigen::Index n) {
    for (Eigen::Index i = 0; i < n; ++i) numbers[i] = exp_positive(numbers[i]);
}

/// 1 / (1 + c / p), `inverse` being 1 / p; 1/2 where nothing is measured.
TRICUE_MULTIVERSION
void write_posterior(const float* __restrict depths, const float* __restrict inverse, Eigen::Index n,
                     float* __restrict posterior) {
    for (Eigen::Index i = 0; i < n; ++i) {
        const float share = 1.0F / (1.0F + kClutter * inverse[i]);
        posterior[i] = has_depth(depths[i]) ? share : 0.5F;
    }
}

void require_arguments(const SampleGrid& grid, const ExpectedDepth& target) {
    require_grid(grid);
    require_positive(target.expected, "expected");
    require_positive(target.sigma, "sigma");
    require_not_negative(target.occluder_margin, "occluder_margin");
}

}  // namespace

DepthPosterior depth_posterior(const DepthView& depth, const SampleGrid& grid, const ExpectedDepth& target) {
    require_arguments(grid, target);
    const Floats depths = read_grid(depth, grid);
    Floats exponents(grid.rows, grid.columns);
    DepthPosterior result{Floats(grid.rows, grid.columns), {}};
    result.nearer.resize(grid.rows, grid.columns);
    measure_deviations(depths.data(), target.expected, 1.0 / target.sigma,
                       target.expected - target.occluder_margin, depths.size(), exponents.data(),
                       result.nearer.data());
    replace_by_exponentials(exponents.data(), exponents.size());
    write_posterior(depths.data(), exponents.data(), depths.size(), result.posterior.data());
    return result;
}

}  // namespace tricue
