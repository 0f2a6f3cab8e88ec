// SPDX-License-Identifier: MIT
#include "fuse/correlation_train.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "check.hpp"
#include "correlation_checks.hpp"
#include "plane_fourier.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void split_row(const float* __restrict cells, const float* __restrict focus, int n, float* __restrict own,
               float* __restrict rest) {
    for (int x = 0; x < n; ++x) {
        own[x] = cells[x] * focus[x];
        rest[x] = cells[x] * (1.0F - focus[x]);
    }
}

TRICUE_MULTIVERSION
void add_energy(const float* __restrict re, const float* __restrict im, float share, int n,
                float* __restrict energy) {
    for (int v = 0; v < n; ++v) energy[v] += share * (re[v] * re[v] + im[v] * im[v]);
}

/// Y conj(X) blended into a numerator; of complex numbers these are pairs of a real and an imaginary part.
TRICUE_MULTIVERSION
void blend_product(const float* __restrict label, const float* __restrict re, const float* __restrict im,
                   const float* __restrict old, float rate, int n, float* __restrict numerator) {
    for (int v = 0; v < n; ++v) {
        const float a = label[2 * v], b = label[2 * v + 1];
        const float own_re = a * re[v] + b * im[v], own_im = b * re[v] - a * im[v];
        numerator[2 * v] = old[2 * v] + rate * (own_re - old[2 * v]);
        numerator[2 * v + 1] = old[2 * v + 1] + rate * (own_im - old[2 * v + 1]);
    }
}

const float* parts(const std::complex<float>* numbers) {
    return reinterpret_cast<const float*>(numbers);
}

float* parts(std::complex<float>* numbers) {
    return reinterpret_cast<float*>(numbers);
}

/// A's blend; B's new part goes into the filter's denominator.
void add_channel(const FloatStack& cells, int k, FloatsRef focus, ComplexesRef label,
                 const ComplexStack& numerator, float rate, float background, PlaneFourier& fourier,
                 CorrelationFilter& filter) {
    std::vector<float> own(static_cast<std::size_t>(cells.cols)), rest(own.size());
    for (int y = 0; y < cells.rows; ++y) {
        split_row(cells.row(k, y), focus.data() + y * focus.cols(), cells.cols, own.data(), rest.data());
        fourier.write_row(y, own.data(), rest.data());
    }
    fourier.transform();
    const int half = numerator.cols;
    for (int u = 0; u < cells.rows; ++u) {
        const ComplexRow x = fourier.spectrum(0, u), other = fourier.spectrum(1, u);
        add_energy(x.re, x.im, 1.0F, half, &filter.denominator(u, 0));
        add_energy(other.re, other.im, background, half, &filter.denominator(u, 0));
        blend_product(parts(label.data() + u * label.cols()), x.re, x.im, parts(numerator.row(k, u)), rate,
                      half, parts(&filter.numerator(k * cells.rows + u, 0)));
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
    require_numerator(numerator, cells);
    require_denominator(denominator, cells);
    CorrelationFilter filter{Complexes(cells.planes * cells.rows, numerator.cols),
                             Floats::Zero(cells.rows, numerator.cols)};
    PlaneFourier fourier(cells.rows, cells.cols);
    const auto share = static_cast<float>(rate);
    for (int k = 0; k < cells.planes; ++k)
        add_channel(cells, k, focus, label, numerator, share, static_cast<float>(background), fourier,
                    filter);
    filter.denominator = denominator + share * (filter.denominator - denominator);
    return filter;
}

}  // namespace tricue
