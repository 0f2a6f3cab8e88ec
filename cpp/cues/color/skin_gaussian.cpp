// SPDX-License-Identifier: MIT
#include "cues/color/skin_gaussian.hpp"

#include <algorithm>
#include <cstring>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

struct Chrominance {
    float mean_b, mean_r;  // minus the offset 128 of both chroma channels
    float bb, br, rr;      // d^2 = bb b^2 + br b r + rr r^2
};

void require_arguments(VectorRef mean, StatesRef p) {
    if (mean.size() != 2 || !mean.isFinite().all()) refuse("mean", "two finite numbers (2,)", "others");
    if (p.rows() != 2 || p.cols() != 2 || !p.isFinite().all())
        refuse("precision", "finite numbers (2, 2)", "others");
    if (p(0, 1) != p(1, 0) || !(p(0, 0) > 0.0) || !(p(0, 0) * p(1, 1) - p(0, 1) * p(1, 0) > 0.0))
        refuse("precision", "a symmetric, positive definite matrix", "another");
}

/// exp(x) for x <= 0, vectorizable with every instruction set: 2^k times a polynomial of the remainder, at most
/// ln(2)/2. Relative error below 1e-6; 0 if exp(x) is below the normal floats, and for NaN, to which a square and a product of
/// finite numbers may overflow.
inline float exp_negative(float x) {
    const float clamped = x >= -87.0F ? x : -87.0F;
    // 1.5 * 2^23: adding it rounds to the nearest integer.
    constexpr float kRounder = 12582912.0F;
    const float shifted = clamped * 1.44269504F + kRounder;
    const float k = shifted - kRounder;
    const float r = (clamped - k * 0.693359375F) + k * 2.12194440e-4F;  // ln 2 in two parts
    const float series =
        1.0F +
        r * (1.0F + r * (1 / 2.0F + r * (1 / 6.0F + r * (1 / 24.0F + r * (1 / 120.0F + r * (1 / 720.0F))))));
    const std::int32_t bits = (static_cast<std::int32_t>(k) + 127) << 23;
    float power;
    std::memcpy(&power, &bits, sizeof power);
    return x >= -87.0F ? series * power : 0.0F;
}

TRICUE_MULTIVERSION
void evaluate(const std::uint8_t* __restrict blue, const std::uint8_t* __restrict green,
              const std::uint8_t* __restrict red, std::ptrdiff_t n, const Chrominance& model,
              float* __restrict out) {
    const Chrominance m = model;
    for_overlapping_blocks(n, [=](std::ptrdiff_t i) {
        const float b = blue[i], g = green[i], r = red[i];
        const float luma = 0.299F * r + 0.587F * g + 0.114F * b;
        const float cb = (b - luma) * (1 / 1.772F) - m.mean_b, cr = (r - luma) * (1 / 1.402F) - m.mean_r;
        out[i] = exp_negative(-0.5F * (m.bb * cb * cb + m.br * cb * cr + m.rr * cr * cr));
    });
}

}  // namespace

Floats skin_gaussian(const SampleView& samples, VectorRef mean, StatesRef precision) {
    require_arguments(mean, precision);
    const auto single = [](double value) { return static_cast<float>(value); };
    const Chrominance model{single(mean[0] - 128.0), single(mean[1] - 128.0), single(precision(0, 0)),
                            single(2.0 * precision(0, 1)), single(precision(1, 1))};
    Floats density(samples.ellipses, samples.n);
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i)
        evaluate(samples.plane(i, 0), samples.plane(i, 1), samples.plane(i, 2), samples.n, model,
                 density.data() + i * samples.n);
    return density;
}

}  // namespace tricue
