// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/gaussian_derivative.hpp"

#include <algorithm>
#include <cmath>

#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

/// With the number of weights known at compile time, the compiler unrolls the inner loop.
template <int Reach, typename Pixel>
TRICUE_INLINE void sum_symmetric(const Pixel* const* rows, const float* __restrict weights, int n,
                                 float* __restrict out) {
    for_overlapping_blocks<kRowLine>(n, [=](std::ptrdiff_t x) {
        float sum = weights[0] * static_cast<float>(rows[0][x]);
        for (int k = 1; k <= Reach; ++k) sum += weights[k] * static_cast<float>(rows[-k][x] + rows[k][x]);
        out[x] = sum;
    });
}

/// `rows` points at the middle one of 2 reach + 1. The order of sums is the same for any reach.
template <typename Pixel>
TRICUE_INLINE void smooth(const Pixel* const* rows, const float* __restrict weights, int reach, int n,
                          float* __restrict out) {
    if (reach == 2) return sum_symmetric<2>(rows, weights, n, out);
    if (reach == 3) return sum_symmetric<3>(rows, weights, n, out);
    if (reach == 4) return sum_symmetric<4>(rows, weights, n, out);
    if (reach == 5) return sum_symmetric<5>(rows, weights, n, out);
    sum_symmetric<0>(rows, weights, n, out);
    for (int k = 1; k <= reach; ++k)
        for (int x = 0; x < n; ++x) out[x] += weights[k] * static_cast<float>(rows[-k][x] + rows[k][x]);
}

template <int Reach>
TRICUE_INLINE void sum_antisymmetric(const float* __restrict in, const float* __restrict weights, int n,
                                     float* __restrict out) {
    for (int x = 0; x < n; ++x) {
        float sum = weights[1] * (in[x + 1] - in[x - 1]);
        for (int k = 2; k <= Reach; ++k) sum += weights[k] * (in[x + k] - in[x - k]);
        out[x] = sum;
    }
}

TRICUE_MULTIVERSION
void smooth_bytes(const std::uint8_t* const* rows, const float* weights, int reach, int n, float* out) {
    smooth(rows, weights, reach, n, out);
}

TRICUE_MULTIVERSION
void smooth_floats(const float* const* rows, const float* weights, int reach, int n, float* out) {
    smooth(rows, weights, reach, n, out);
}

TRICUE_MULTIVERSION
void differentiate_across(const float* __restrict in, const float* __restrict weights, int reach, int n,
                          float* __restrict out) {
    if (reach == 2) return sum_antisymmetric<2>(in, weights, n, out);
    if (reach == 3) return sum_antisymmetric<3>(in, weights, n, out);
    if (reach == 4) return sum_antisymmetric<4>(in, weights, n, out);
    if (reach == 5) return sum_antisymmetric<5>(in, weights, n, out);
    for (int x = 0; x < n; ++x) out[x] = weights[1] * (in[x + 1] - in[x - 1]);
    for (int k = 2; k <= reach; ++k)
        for (int x = 0; x < n; ++x) out[x] += weights[k] * (in[x + k] - in[x - k]);
}

}  // namespace

GaussianDerivative::GaussianDerivative(double sigma) : reach(static_cast<int>(std::ceil(2.5 * sigma))) {
    std::array<double, kMaxReach + 1> gaussian{};
    double total = 0.0, moment = 0.0;
    for (int k = 0; k <= reach; ++k) {
        const auto at = static_cast<std::size_t>(k);
        gaussian[at] = std::exp(-k * k / (2.0 * sigma * sigma));
        total += (k == 0 ? 1.0 : 2.0) * gaussian[at];
        moment += 2.0 * k * k * gaussian[at];
    }
    smooth.fill(0.0F);
    derivative.fill(0.0F);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(reach); ++k) {
        smooth[k] = static_cast<float>(gaussian[k] / total);
        derivative[k] = static_cast<float>(static_cast<double>(k) * gaussian[k] / moment);
    }
}

DerivativeRows::DerivativeRows(const GrayLevel& level, const GaussianDerivative& filter, int x0, int x1,
                               int padding)
    : level_(level),
      filter_(filter),
      x0_(x0),
      x1_(x1),
      padding_(padding),
      smooth_(static_cast<std::size_t>(x1 - x0 + 2 * filter.reach + kRowLine)),
      derivative_(static_cast<std::size_t>(x1 - x0 + 2 * padding + kRowLine)) {}

/// The rows that the filter reads, from column x on.
template <typename Picture>
auto DerivativeRows::rows_around(const Picture& picture, int y, int x) const {
    std::array<decltype(picture.row(y)), 2 * GaussianDerivative::kMaxReach + 1> rows;
    for (int k = -filter_.reach; k <= filter_.reach; ++k)
        rows[static_cast<std::size_t>(filter_.reach + k)] =
            picture.row(std::clamp(y + k, 0, level_.rows() - 1)) + x;
    return rows;
}

const float* DerivativeRows::row(int y) {
    const int reach = filter_.reach, begin = std::max(x0_ - reach, 0),
              end = std::min(x1_ + reach, level_.cols());
    float* inside = smooth_.data() + (begin - (x0_ - reach));
    const float* weights = filter_.smooth.data();
    if (level_.image != nullptr)
        smooth_bytes(rows_around(*level_.image, y, begin).data() + reach, weights, reach, end - begin,
                     inside);
    else
        smooth_floats(rows_around(*level_.plane, y, begin).data() + reach, weights, reach, end - begin,
                      inside);
    std::fill(smooth_.data(), inside, *inside);
    std::fill_n(inside + (end - begin), x1_ + reach - end, inside[end - begin - 1]);

    float* inner = derivative_.data() + padding_;
    differentiate_across(smooth_.data() + reach, filter_.derivative.data(), reach, whole_lines(x1_ - x0_),
                         inner);
    std::fill(derivative_.data(), inner, *inner);
    std::fill_n(inner + (x1_ - x0_), padding_, inner[x1_ - x0_ - 1]);
    return inner - x0_;
}

}  // namespace tricue
