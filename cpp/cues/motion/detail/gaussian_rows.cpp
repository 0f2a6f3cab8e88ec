// SPDX-License-Identifier: MIT
#include "cues/motion/detail/gaussian_rows.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/motion/detail/row_block.hpp"

namespace tricue {
namespace {

constexpr double kSupportSigmas = 3.5;  // sigmas on each side, up to the outer edge of the last pixel
constexpr int kUsualRadius = 3;         // of the flow and depth tracker's sigma, 0.8 pixels

/// The weights and rows of filter_across.
struct AcrossFilters {
    int radius;
    const float *smooth_weights, *slope_weights, *curvature_weights;
    float *smooth, *slope, *curvature;
};

template <typename Block, bool kWithCurvature>
TRICUE_INLINE void filter_block_across(const float* row, int x, int radius, const AcrossFilters& filters) {
    Block middle, left, right, sum, difference, smooth_sum{}, slope_sum{}, curvature_sum{};
    load(row + x, middle);
    add(filters.smooth_weights[0], middle, smooth_sum);
    if (kWithCurvature) add(filters.curvature_weights[0], middle, curvature_sum);
    for (int k = 1; k <= radius; ++k) {
        load(row + x - k, left);
        load(row + x + k, right);
        sum_and_difference(left, right, sum, difference);
        add(filters.smooth_weights[k], sum, smooth_sum);
        add(filters.slope_weights[k], difference, slope_sum);
        if (kWithCurvature) add(filters.curvature_weights[k], sum, curvature_sum);
    }
    store(smooth_sum, filters.smooth + x);
    store(slope_sum, filters.slope + x);
    if (kWithCurvature) store(curvature_sum, filters.curvature + x);
}

/// kRadius 0 is any; a radius that is known at compile time leaves sums and weights in registers.
template <bool kWithCurvature, int kRadius>
TRICUE_INLINE void filter_across_by(const float* row, int n, const AcrossFilters& filters) {
    const AcrossFilters each = filters;
    const int radius = kRadius > 0 ? kRadius : each.radius, blocks = in_row_blocks(n);
    for (int x = 0; x < blocks; x += kRowBlock)
        filter_block_across<RowBlock, kWithCurvature>(row, x, radius, each);
    if (blocks < n) filter_block_across<HalfBlock, kWithCurvature>(row, blocks, radius, each);
}

template <typename Block, bool kOdd>
TRICUE_INLINE void filter_block_down(const float* const* rows, int x, int radius, const float* weights,
                                     float* out) {
    Block middle, above, below, sum, difference, total{};
    load(rows[radius] + x, middle);
    if (!kOdd) add(weights[0], middle, total);
    for (int k = 1; k <= radius; ++k) {
        load(rows[radius - k] + x, above);
        load(rows[radius + k] + x, below);
        sum_and_difference(above, below, sum, difference);
        add(weights[k], kOdd ? difference : sum, total);
    }
    store(total, out + x);
}

template <bool kOdd, int kRadius>
TRICUE_INLINE void filter_down_by(const ColumnFilter& filter, int any_radius, int n) {
    const int radius = kRadius > 0 ? kRadius : any_radius, blocks = in_row_blocks(n);
    for (int x = 0; x < blocks; x += kRowBlock)
        filter_block_down<RowBlock, kOdd>(filter.rows, x, radius, filter.weights, filter.out);
    if (blocks < n)
        filter_block_down<HalfBlock, kOdd>(filter.rows, blocks, radius, filter.weights, filter.out);
}

TRICUE_MULTIVERSION
void across_three(const float* row, int n, const AcrossFilters& filters) {
    if (filters.radius == kUsualRadius)
        filter_across_by<true, kUsualRadius>(row, n, filters);
    else
        filter_across_by<true, 0>(row, n, filters);
}

TRICUE_MULTIVERSION
void across_two(const float* row, int n, const AcrossFilters& filters) {
    if (filters.radius == kUsualRadius)
        filter_across_by<false, kUsualRadius>(row, n, filters);
    else
        filter_across_by<false, 0>(row, n, filters);
}

template <int kRadius>
TRICUE_INLINE void filter_rows_down_by(const ColumnFilter* filters, int count, int radius, int n) {
    for (int i = 0; i < count; ++i) {
        const ColumnFilter filter = filters[i];
        if (filter.odd)
            filter_down_by<true, kRadius>(filter, radius, n);
        else
            filter_down_by<false, kRadius>(filter, radius, n);
    }
}

TRICUE_MULTIVERSION
void filter_rows_down(const ColumnFilter* filters, int count, int radius, int n) {
    if (radius == kUsualRadius)
        filter_rows_down_by<kUsualRadius>(filters, count, radius, n);
    else
        filter_rows_down_by<0>(filters, count, radius, n);
}

}  // namespace

GaussianTaps::GaussianTaps(double sigma) : radius(static_cast<int>(std::ceil(kSupportSigmas * sigma - 0.5))) {
    std::vector<double> samples(static_cast<std::size_t>(radius) + 1);
    for (auto* weights : {&smooth, &slope, &curvature}) weights->reserve(samples.size());
    double sum = 0, square = 0, fourth = 0;  // of the samples on both sides, times x^0, x^2, x^4
    for (int x = 0; x <= radius; ++x) {
        const double sample = std::exp(-x * x / (2 * sigma * sigma)), sides = x == 0 ? 1 : 2;
        samples[static_cast<std::size_t>(x)] = sample;
        sum += sides * sample;
        square += sides * sample * x * x;
        fourth += sides * sample * x * x * x * x;
    }
    square /= sum;
    fourth /= sum;
    for (int x = 0; x <= radius; ++x) {
        const double share = samples[static_cast<std::size_t>(x)] / sum;
        smooth.push_back(static_cast<float>(share));
        slope.push_back(static_cast<float>(x * share / square));
        curvature.push_back(static_cast<float>(2 * (x * x - square) * share / (fourth - square * square)));
    }
}

void require_sigma(double sigma) {
    if (!(sigma >= 0.5 && sigma <= 16)) refuse("sigma", "0.5 to 16 pixels", sigma);
}

void filter_across(const float* row, const GaussianTaps& taps, int n, float* smooth, float* slope,
                   float* curvature) {
    across_three(row, n,
                 {taps.radius, taps.smooth.data(), taps.slope.data(), taps.curvature.data(), smooth, slope,
                  curvature});
}

void filter_across(const float* row, const GaussianTaps& taps, int n, float* smooth, float* slope) {
    across_two(row, n, {taps.radius, taps.smooth.data(), taps.slope.data(), nullptr, smooth, slope, nullptr});
}

void filter_down(const ColumnFilter* filters, int count, int radius, int n) {
    filter_rows_down(filters, count, radius, n);
}

}  // namespace tricue
