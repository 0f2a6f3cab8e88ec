// SPDX-License-Identifier: MIT
#include "fuse/scale_train.hpp"

#include "base/simd.hpp"
#include "fuse/detail/correlation_checks.hpp"
#include "fuse/detail/scale_fourier.hpp"

namespace tricue {
namespace {

constexpr int kPartialSums = 16;

TRICUE_MULTIVERSION
void sum_energy(const float* re, const float* im, int n, float* energy) {
    float parts[kPartialSums] = {};
    int d = 0;
    for (; d + kPartialSums <= n; d += kPartialSums)
        for (int j = 0; j < kPartialSums; ++j) parts[j] += re[d + j] * re[d + j] + im[d + j] * im[d + j];
    for (int j = 0; d < n; ++d, ++j) parts[j] += re[d] * re[d] + im[d] * im[d];
    *energy = 0;
    for (int j = 0; j < kPartialSums; ++j) *energy += parts[j];
}

/// Y conj(X) blended into a numerator; complex numbers are pairs of a real and an imaginary part.
TRICUE_MULTIVERSION
void blend_products(float a, float b, const float* __restrict re, const float* __restrict im,
                    const float* __restrict old, float rate, int n, float* __restrict numerator) {
    for (int d = 0; d < n; ++d) {
        const float own_re = a * re[d] + b * im[d], own_im = b * re[d] - a * im[d];
        numerator[2 * d] = old[2 * d] + rate * (own_re - old[2 * d]);
        numerator[2 * d + 1] = old[2 * d + 1] + rate * (own_im - old[2 * d + 1]);
    }
}

}  // namespace

ScaleFilter scale_train(FloatsRef looks, ComplexesRef label, ComplexesRef numerator, FloatsRef denominator,
                        double rate) {
    require_looks(looks, numerator, denominator);
    require_frequencies("label", label.cols(), numerator.rows());
    require_rate(rate);
    const int channels = static_cast<int>(looks.cols());
    const ScaleSpectra spectra(looks);
    ScaleFilter filter{Complexes(spectra.half(), channels), Eigen::ArrayXf(spectra.half())};
    const auto share = static_cast<float>(rate);
    for (Eigen::Index u = 0; u < spectra.half(); ++u) {
        const auto* old = reinterpret_cast<const float*>(numerator.data() + u * channels);
        auto* blended = reinterpret_cast<float*>(filter.numerator.data() + u * channels);
        const std::complex<float> y = label(0, u);
        blend_products(y.real(), y.imag(), spectra.re(u), spectra.im(u), old, share, channels, blended);
        float energy = 0;
        sum_energy(spectra.re(u), spectra.im(u), channels, &energy);
        filter.denominator[u] = denominator(0, u) + share * (energy - denominator(0, u));
    }
    return filter;
}

}  // namespace tricue
