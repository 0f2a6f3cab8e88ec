// SPDX-License-Identifier: MIT
#include "fuse/correlation_response.hpp"

#include <algorithm>

#include "base/simd.hpp"
#include "fuse/detail/correlation_checks.hpp"
#include "fuse/detail/plane_fourier.hpp"

namespace tricue {
namespace {

/// Adds A_k Z_k; `filter` holds pairs of a real and an imaginary part.
TRICUE_MULTIVERSION
void add_product(const float* __restrict filter, const float* __restrict re, const float* __restrict im,
                 std::size_t n, float* __restrict sum_re, float* __restrict sum_im) {
    for (std::size_t v = 0; v < n; ++v) {
        const float a = filter[2 * v], b = filter[2 * v + 1];
        sum_re[v] += a * re[v] - b * im[v];
        sum_im[v] += a * im[v] + b * re[v];
    }
}

/// One row of real and one of imaginary parts for each filter.
struct Spectra {
    Floats re, im;
};

Spectra sum_products(const FloatStack& cells, const FilterStack& filters, PlaneFourier& planes) {
    const auto n = static_cast<Eigen::Index>(planes.count());
    Spectra sums{Floats::Zero(filters.filters, n), Floats::Zero(filters.filters, n)};
    Floats re(2, n), im(2, n);
    for (int k = 0; k < cells.planes; k += 2) {
        const int last = std::min(k + 1, cells.planes - 1);
        planes.transform(cells.row(k, 0), cells.row(last, 0), &re(0, 0), &im(0, 0), &re(1, 0), &im(1, 0));
        for (int filter = 0; filter < filters.filters; ++filter)
            for (int plane = k; plane <= last; ++plane)
                add_product(as_floats(filters.plane(filter, plane)), &re(plane - k, 0), &im(plane - k, 0),
                            planes.count(), &sums.re(filter, 0), &sums.im(filter, 0));
    }
    return sums;
}

/// Writes the plane with zero shift in the middle.
void write_shifted(const Floats& plane, float* response) {
    const Eigen::Index rows = plane.rows(), cols = plane.cols(),
                       right = cols / 2;  // destination of the first column
    for (Eigen::Index y = 0; y < rows; ++y) {
        float* to = response + (y + rows / 2) % rows * cols;
        std::copy_n(&plane(y, 0), cols - right, to + right);
        std::copy_n(&plane(y, 0) + cols - right, right, to);
    }
}

}  // namespace

Floats correlation_response(const FloatStack& cells, const FilterStack& filters) {
    require_cells(cells);
    require_filters(filters, cells);
    const int rows = cells.rows, cols = cells.cols, count = filters.filters;
    PlaneFourier planes(rows, cols);
    const Spectra sums = sum_products(cells, filters, planes);
    Floats responses(count * rows, cols), first(rows, cols), second(rows, cols);
    for (int filter = 0; filter < count; filter += 2) {
        const int last = std::min(filter + 1, count - 1);
        Floats& other = last == filter ? first : second;
        planes.invert(&sums.re(filter, 0), &sums.im(filter, 0), &sums.re(last, 0), &sums.im(last, 0),
                      first.data(), other.data());
        write_shifted(first, &responses(filter * rows, 0));
        write_shifted(other, &responses(last * rows, 0));
    }
    return responses;
}

}  // namespace tricue
