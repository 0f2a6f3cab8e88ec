// SPDX-License-Identifier: MIT
#include "cues/color/skin_gaussian.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/exp_negative.hpp"
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
