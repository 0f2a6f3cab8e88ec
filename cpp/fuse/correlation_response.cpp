// SPDX-License-Identifier: MIT
#include "fuse/correlation_response.hpp"

#include <algorithm>

#include "correlation_checks.hpp"
#include "plane_fourier.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

/// A row of A_k Z_k more; `numerator` holds pairs of a real and an imaginary part.
TRICUE_MULTIVERSION
void add_product(const float* numerator, const float* re, const float* im, int n, float* sum_re,
                 float* sum_im) {
    TRICUE_INDEPENDENT
    for (int v = 0; v < n; ++v) {
        const float a = numerator[2 * v], b = numerator[2 * v + 1];
        sum_re[v] += a * re[v] - b * im[v];
        sum_im[v] += a * im[v] + b * re[v];
    }
}

TRICUE_MULTIVERSION
void divide(const float* __restrict denominator, float lambda, int n, float* __restrict re,
            float* __restrict im) {
    for (int v = 0; v < n; ++v) {
        const float share = 1.0F / (denominator[v] + lambda);
        re[v] *= share;
        im[v] *= share;
    }
}

void add_products(const FloatStack& cells, const ComplexStack& numerator, PlaneInverse& sum) {
    PlaneFourier fourier(cells.rows, cells.cols);
    for (int k = 0; k < cells.planes; k += 2) {
        const int second =
            std::min(k + 1, cells.planes - 1);  // without another channel this one again, unread
        for (int y = 0; y < cells.rows; ++y) fourier.write_row(y, cells.row(k, y), cells.row(second, y));
        fourier.transform();
        for (int plane = k; plane <= second; ++plane)
            for (int u = 0; u < cells.rows; ++u) {
                const ComplexRow z = fourier.spectrum(plane - k, u), out = sum.spectrum(u);
                const auto* a = reinterpret_cast<const float*>(numerator.row(plane, u));
                add_product(a, z.re, z.im, numerator.cols, out.re, out.im);
            }
    }
}

/// With no shift in the middle.
Floats shifted(PlaneInverse& answer, int rows, int cols) {
    Floats response(rows, cols);
    const float whole = 1.0F / static_cast<float>(rows * cols);
    for (int x = 0; x < cols; ++x) {
        const float* column = answer.column(x);
        const int to = (x + cols / 2) % cols;
        for (int y = 0; y < rows; ++y) response((y + rows / 2) % rows, to) = whole * column[y];
    }
    return response;
}

}  // namespace

Floats correlation_response(const FloatStack& cells, const ComplexStack& numerator, FloatsRef denominator,
                            double ridge) {
    require_cells(cells);
    require_numerator(numerator, cells);
    require_denominator(denominator, cells);
    require_ridge(ridge);
    PlaneInverse answer(cells.rows, cells.cols);
    add_products(cells, numerator, answer);
    const double mean = denominator.cast<double>().mean();
    const auto lambda = static_cast<float>(ridge * std::max(mean, 1e-12));
    for (int u = 0; u < cells.rows; ++u) {
        const ComplexRow row = answer.spectrum(u);
        divide(denominator.data() + u * denominator.cols(), lambda, numerator.cols, row.re, row.im);
    }
    answer.transform();
    return shifted(answer, cells.rows, cells.cols);
}

}  // namespace tricue
