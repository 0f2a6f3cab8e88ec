// SPDX-License-Identifier: MIT
#include "fuse/correlation_train.hpp"

#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "fuse/detail/correlation_checks.hpp"
#include "fuse/detail/plane_fourier.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void split_by_focus(const float* __restrict cells, const float* __restrict focus, std::size_t n,
                    float* __restrict own, float* __restrict rest) {
    for (std::size_t i = 0; i < n; ++i) {
        own[i] = cells[i] * focus[i];
        rest[i] = cells[i] * (1.0F - focus[i]);
    }
}

/// Adds |X|² of the focus, and `background` times that of the rest.
TRICUE_MULTIVERSION
void add_energy(const float* __restrict re, const float* __restrict im, const float* __restrict rest_re,
                const float* __restrict rest_im, float background, std::size_t n, float* __restrict energy) {
    for (std::size_t i = 0; i < n; ++i)
        energy[i] += (re[i] * re[i] + im[i] * im[i]) +
                     background * (rest_re[i] * rest_re[i] + rest_im[i] * rest_im[i]);
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

const float* as_floats(const std::complex<float>* numbers) {
    return reinterpret_cast<const float*>(numbers);
}

float* as_floats(std::complex<float>* numbers) {
    return reinterpret_cast<float*>(numbers);
}

/// Blends the numerator A, and sums the new part of the denominator B. The focus and the rest are transformed together.
void add_channels(const FloatStack& cells, FloatsRef focus, ComplexesRef label, const ComplexStack& numerator,
                  float rate, float background, CorrelationFilter& filter) {
    PlaneFourier planes(cells.rows, cells.cols);
    const std::size_t n = planes.count(), whole = static_cast<std::size_t>(focus.size());
    std::vector<float> own(whole), rest(whole), re(n), im(n), rest_re(n), rest_im(n);
    for (int k = 0; k < cells.planes; ++k) {
        split_by_focus(cells.row(k, 0), focus.data(), whole, own.data(), rest.data());
        planes.transform(own.data(), rest.data(), re.data(), im.data(), rest_re.data(), rest_im.data());
        add_energy(re.data(), im.data(), rest_re.data(), rest_im.data(), background, n,
                   filter.denominator.data());
        blend_product(as_floats(label.data()), re.data(), im.data(), as_floats(numerator.row(k, 0)), rate, n,
                      as_floats(&filter.numerator(k * cells.rows, 0)));
    }
}

void require_arguments(const FloatStack& cells, FloatsRef focus, ComplexesRef label, double rate,
                       double background) {
    require_cells(cells);
    require_rate(rate);
    if (!(background >= 0.0 && std::isfinite(background)))
        refuse("background", "a finite number, not negative", background);
    require_plane("focus", focus.rows(), focus.cols(), cells.rows, cells.cols);
    require_plane("label", label.rows(), label.cols(), cells.rows, cells.cols / 2 + 1);
}

}  // namespace

CorrelationFilter correlation_train(const FloatStack& cells, FloatsRef focus, ComplexesRef label,
                                    const ComplexStack& numerator, FloatsRef denominator, double rate,
                                    double background) {
    require_arguments(cells, focus, label, rate, background);
    require_filter("numerator", numerator, cells);
    require_denominator(denominator, cells);
    CorrelationFilter filter{Complexes(cells.planes * cells.rows, numerator.cols),
                             Floats::Zero(cells.rows, numerator.cols)};
    const auto share = static_cast<float>(rate);
    add_channels(cells, focus, label, numerator, share, static_cast<float>(background), filter);
    filter.denominator = denominator + share * (filter.denominator - denominator);
    return filter;
}

}  // namespace tricue
