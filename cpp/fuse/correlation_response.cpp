// SPDX-License-Identifier: MIT
#include "fuse/correlation_response.hpp"

#include <algorithm>

#include "base/simd.hpp"
#include "fuse/detail/correlation_checks.hpp"
#include "fuse/detail/plane_fourier.hpp"

namespace tricue {
namespace {

/// Adds A_k Z_k; `numerator` holds pairs of a real and an imaginary part.
TRICUE_MULTIVERSION
void add_product(const float* __restrict numerator, const float* __restrict re, const float* __restrict im,
                 std::size_t n, float* __restrict sum_re, float* __restrict sum_im) {
    for (std::size_t v = 0; v < n; ++v) {
        const float a = numerator[2 * v], b = numerator[2 * v + 1];
        sum_re[v] += a * re[v] - b * im[v];
        sum_im[v] += a * im[v] + b * re[v];
    }
}

TRICUE_MULTIVERSION
void divide(const float* __restrict denominator, float lambda, std::size_t n, float* __restrict re,
            float* __restrict im) {
    for (std::size_t v = 0; v < n; ++v) {
        const float share = 1.0F / (denominator[v] + lambda);
        re[v] *= share;
        im[v] *= share;
    }
}

/// One row of real and one of imaginary parts for each filter.
struct Spectra {
    Floats re, im;
};

Spectra sum_products(const FloatStack& cells, const FilterStack& numerators, PlaneFourier& planes) {
    const auto n = static_cast<Eigen::Index>(planes.count());
    Spectra sums{Floats::Zero(numerators.filters, n), Floats::Zero(numerators.filters, n)};
    Floats re(2, n), im(2, n);
    for (int k = 0; k < cells.planes; k += 2) {
        const int last = std::min(k + 1, cells.planes - 1);
        planes.transform(cells.row(k, 0), cells.row(last, 0), &re(0, 0), &im(0, 0), &re(1, 0), &im(1, 0));
        for (int filter = 0; filter < numerators.filters; ++filter)
            for (int plane = k; plane <= last; ++plane)
                add_product(reinterpret_cast<const float*>(numerators.plane(filter, plane)),
                            &re(plane - k, 0), &im(plane - k, 0), planes.count(), &sums.re(filter, 0),
                            &sums.im(filter, 0));
    }
    return sums;
}

void divide_all(const FloatStack& denominators, double ridge, Spectra& sums) {
    const Eigen::Index n = sums.re.cols();
    for (int filter = 0; filter < denominators.planes; ++filter) {
        const Eigen::Map<const Floats> denominator(denominators.row(filter, 0), 1, n);
        const double mean = denominator.cast<double>().mean();
        const auto lambda = static_cast<float>(ridge * std::max(mean, 1e-12));
        divide(denominator.data(), lambda, static_cast<std::size_t>(n), &sums.re(filter, 0),
               &sums.im(filter, 0));
    }
}

/// Writes the plane with zero shift in the middle.
void write_shifted(const Floats& plane, float* response) {
    const Eigen::Index rows = plane.rows(), cols = plane.cols(),
                       right = cols / 2;  // where the first column goes
    for (Eigen::Index y = 0; y < rows; ++y) {
        float* to = response + (y + rows / 2) % rows * cols;
        std::copy_n(&plane(y, 0), cols - right, to + right);
        std::copy_n(&plane(y, 0) + cols - right, right, to);
    }
}

}  // namespace

Floats correlation_response(const FloatStack& cells, const FilterStack& numerators,
                            const FloatStack& denominators, double ridge) {
    require_cells(cells);
    require_filters(numerators, denominators, cells);
    require_ridge(ridge);
    const int rows = cells.rows, cols = cells.cols, filters = numerators.filters;
    PlaneFourier planes(rows, cols);
    Spectra sums = sum_products(cells, numerators, planes);
    divide_all(denominators, ridge, sums);
    Floats responses(filters * rows, cols), first(rows, cols), second(rows, cols);
    for (int filter = 0; filter < filters; filter += 2) {
        const int last = std::min(filter + 1, filters - 1);
        Floats& other = last == filter ? first : second;
        planes.invert(&sums.re(filter, 0), &sums.im(filter, 0), &sums.re(last, 0), &sums.im(last, 0),
                      first.data(), other.data());
        write_shifted(first, &responses(filter * rows, 0));
        write_shifted(other, &responses(last * rows, 0));
    }
    return responses;
}

}  // namespace tricue
