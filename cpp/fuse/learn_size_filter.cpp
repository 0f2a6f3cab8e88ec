// SPDX-License-Identifier: MIT
#include "fuse/learn_size_filter.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "fuse/detail/blend_filters.hpp"
#include "fuse/detail/correlation_checks.hpp"
#include "fuse/detail/picked_cells.hpp"
#include "fuse/detail/plane_fourier.hpp"

namespace tricue {
namespace {

constexpr double kMinMean = 1e-12;  // lower bound of a denominator's mean

TRICUE_MULTIVERSION
void invert(float ridge, std::ptrdiff_t n, float* __restrict denominator) {
    for (std::ptrdiff_t i = 0; i < n; ++i) denominator[i] = 1.0F / (denominator[i] + ridge);
}

/// Multiplies n complex numbers, pairs of a real and an imaginary part, by factors.
TRICUE_MULTIVERSION
void scale(const float* __restrict factors, std::ptrdiff_t n, float* __restrict pairs) {
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        pairs[2 * i] *= factors[i];
        pairs[2 * i + 1] *= factors[i];
    }
}

/// The factors by which a denominator divides.
Floats find_factors(const Floats& learned, FloatsRef first, float share, double ridge) {
    Floats factors(learned.rows(), learned.cols());
    blend_filters(learned.data(), first.data(), share, learned.size(), factors.data());
    double sum = 0.0;
    for (Eigen::Index i = 0; i < factors.size(); ++i) sum += factors.data()[i];
    const double mean = std::max(sum / static_cast<double>(factors.size()), kMinMean);
    invert(static_cast<float>(ridge * mean), factors.size(), factors.data());
    return factors;
}

}  // namespace

SizeFilter learn_size_filter(const ImageView& patch, PlacesRef places, FloatsRef taper, ComplexesRef label,
                             const FilterParts& learned, const FilterParts& first, double rate,
                             double first_weight, double ridge) {
    require_share_of_first(first_weight);
    require_positive(ridge, "ridge");
    const FloatPlanes numbers = picked_cells(patch, places, taper);
    const FloatStack cells = numbers.view();
    const int rows = cells.rows;
    require_filter("first_numerator", first.numerator, cells);
    require_shape(first.denominator.rows(), first.denominator.cols(), rows, cells.cols / 2 + 1,
                  "first_denominator");
    CorrelationFilter filter = correlation_train(cells, label, learned.numerator, learned.denominator, rate);
    const auto share = static_cast<float>(first_weight);
    const Floats factors = find_factors(filter.denominator, first.denominator, share, ridge);
    Complexes applied(filter.numerator.rows(), filter.numerator.cols());
    blend_filters(filter.numerator.data(), first.numerator.data, share, applied.size(), applied.data());
    for (int k = 0; k < cells.planes; ++k)
        scale(factors.data(), factors.size(), as_floats(&applied(Eigen::Index{k} * rows, 0)));
    return {std::move(filter), std::move(applied)};
}

}  // namespace tricue
