// SPDX-License-Identifier: MIT
#include "fuse/scale_response.hpp"

#include <algorithm>

#include "base/simd.hpp"
#include "fuse/detail/correlation_checks.hpp"
#include "fuse/detail/scale_fourier.hpp"

namespace tricue {
namespace {

constexpr int kPartialSums = 16;

/// sum of A Z; `a` holds pairs of a real and an imaginary part.
TRICUE_MULTIVERSION
void sum_products(const float* a, const float* re, const float* im, int n, float* sum_re, float* sum_im) {
    float part_re[kPartialSums] = {}, part_im[kPartialSums] = {};
    int d = 0;
    for (; d + kPartialSums <= n; d += kPartialSums) {
        TRICUE_INDEPENDENT
        for (int j = 0; j < kPartialSums; ++j) {
            const float x = a[2 * (d + j)], y = a[2 * (d + j) + 1];
            part_re[j] += x * re[d + j] - y * im[d + j];
            part_im[j] += x * im[d + j] + y * re[d + j];
        }
    }
    for (int j = 0; d < n; ++d, ++j) {
        part_re[j] += a[2 * d] * re[d] - a[2 * d + 1] * im[d];
        part_im[j] += a[2 * d] * im[d] + a[2 * d + 1] * re[d];
    }
    *sum_re = *sum_im = 0;
    for (int j = 0; j < kPartialSums; ++j) {
        *sum_re += part_re[j];
        *sum_im += part_im[j];
    }
}

}  // namespace

Eigen::ArrayXf scale_response(FloatsRef looks, ComplexesRef numerator, FloatsRef denominator, double ridge) {
    require_looks(looks, numerator, denominator);
    require_ridge(ridge);
    const int scales = static_cast<int>(looks.rows()), channels = static_cast<int>(looks.cols());
    const ScaleSpectra spectra(looks);
    const double mean = denominator.cast<double>().mean();
    const auto lambda = static_cast<float>(ridge * std::max(mean, 1e-12));
    Eigen::ArrayXf re(spectra.half()), im(spectra.half());
    for (Eigen::Index u = 0; u < spectra.half(); ++u) {
        const auto* a = reinterpret_cast<const float*>(numerator.data() + u * channels);
        sum_products(a, spectra.re(u), spectra.im(u), channels, &re[u], &im[u]);
    }
    const Eigen::ArrayXf shares = 1.0F / (denominator.row(0).transpose() + lambda);
    const Eigen::ArrayXf signal = invert_scale_spectrum(re * shares, im * shares, scales);
    Eigen::ArrayXf response(scales);
    response << signal.tail(scales / 2), signal.head(scales - scales / 2);
    return response;
}

}  // namespace tricue
