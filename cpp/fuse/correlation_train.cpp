// SPDX-License-Identifier: MIT
#include "fuse/correlation_train.hpp"

#include <algorithm>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "fuse/detail/correlation_checks.hpp"
#include "fuse/detail/plane_fourier.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void add_energy(const float* __restrict re, const float* __restrict im, std::size_t n,
                float* __restrict energy) {
    for (std::size_t i = 0; i < n; ++i) energy[i] += re[i] * re[i] + im[i] * im[i];
}

/// Y conj(X) blended into a numerator; complex numbers are pairs of a real and an imaginary part.
TRICUE_MULTIVERSION
void blend_product(const float* __restrict label, const float* __restrict re, const float* __restrict im,
                   const float* __restrict old, float rate, std::size_t n, float* __restrict numerator) {
    for (std::size_t i = 0; i < n; ++i) {
        const float a = label[2 * i], b = label[2 * i + 1];
        const float own_re = a * re[i] + b * im[i], own_im = b * re[i] - a * im[i];
        numerator[2 * i] = old[2 * i] + rate * (own_re - old[2 * i]);
        numerator[2 * i + 1] = old[2 * i + 1] + rate * (own_im - old[2 * i + 1]);
    }
}

/// Blends the numerator A, and sums the new part of the denominator B. Two channels are transformed together.
void add_channels(const FloatStack& cells, ComplexesRef label, const ComplexStack& numerator, float rate,
                  CorrelationFilter& filter) {
    PlaneFourier planes(cells.rows, cells.cols);
    const std::size_t n = planes.count();
    std::vector<float> re(2 * n), im(2 * n);
    for (int k = 0; k < cells.planes; k += 2) {
        const int last = std::min(k + 1, cells.planes - 1);
        planes.transform(cells.row(k, 0), cells.row(last, 0), &re[0], &im[0], &re[n], &im[n]);
        for (int channel = k; channel <= last; ++channel) {
            const std::size_t from = channel == k ? 0 : n;
            add_energy(&re[from], &im[from], n, filter.denominator.data());
            blend_product(as_floats(label.data()), &re[from], &im[from], as_floats(numerator.row(channel, 0)),
                          rate, n, as_floats(&filter.numerator(channel * cells.rows, 0)));
        }
    }
}

}  // namespace

CorrelationFilter correlation_train(const FloatStack& cells, ComplexesRef label,
                                    const ComplexStack& numerator, FloatsRef denominator, double rate) {
    require_cells(cells);
    require_rate(rate);
    require_shape(label.rows(), label.cols(), cells.rows, cells.cols / 2 + 1, "label");
    require_filter("numerator", numerator, cells);
    require_denominator(denominator, cells);
    CorrelationFilter filter{Complexes(cells.planes * cells.rows, numerator.cols),
                             Floats::Zero(cells.rows, numerator.cols)};
    const auto share = static_cast<float>(rate);
    add_channels(cells, label, numerator, share, filter);
    filter.denominator = denominator + share * (filter.denominator - denominator);
    return filter;
}

}  // namespace tricue
