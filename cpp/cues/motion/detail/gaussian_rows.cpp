// SPDX-License-Identifier: MIT
#include "cues/motion/detail/gaussian_rows.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/row_block.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr double kSupportSigmas = 3.5;  // sigmas on each side, up to the outer edge of the last pixel

template <int kBytes, bool kWithCurvature>
TRICUE_INLINE void filter_part_across(const AcrossFilters& filters, const TapView& taps, int radius, int x) {
    RowLanes<kBytes> middle, left, right, sum, difference, smooth_sum{}, slope_sum{}, curvature_sum{};
    const float* row = filters.row + x;
    load(row, middle);
    add(taps.smooth[0], middle, smooth_sum);
    if (kWithCurvature) add(taps.curvature[0], middle, curvature_sum);
    for (int k = 1; k <= radius; ++k) {
        load(row - k, left);
        load(row + k, right);
        sum_and_difference(left, right, sum, difference);
        add(taps.smooth[k], sum, smooth_sum);
        add(taps.slope[k], difference, slope_sum);
        if (kWithCurvature) add(taps.curvature[k], sum, curvature_sum);
    }
    store(smooth_sum, filters.smooth + x);
    store(slope_sum, filters.slope + x);
    if (kWithCurvature) store(curvature_sum, filters.curvature + x);
}

/// kRadius 0 stands for any radius; a radius known at compile time keeps sums and weights in registers.
template <int kBytes, bool kWithCurvature, int kRadius>
TRICUE_INLINE void filter_across_by(const AcrossFilters* rows, int count, const TapView& taps, int n) {
    const TapView weights = taps;
    const int radius = kRadius > 0 ? kRadius : weights.radius;
    for (int i = 0; i < count; ++i) {
        const AcrossFilters filters = rows[i];
        for (int x = 0; x < n; x += kRowLanes<kBytes>)
            filter_part_across<kBytes, kWithCurvature>(filters, weights, radius, x);
    }
}

template <int kBytes, bool kWithCurvature>
TRICUE_INLINE void filter_rows_across(const AcrossFilters* rows, int count, const TapView& taps, int n) {
    if (taps.radius == kUsualRadius)
        filter_across_by<kBytes, kWithCurvature, kUsualRadius>(rows, count, taps, n);
    else
        filter_across_by<kBytes, kWithCurvature, 0>(rows, count, taps, n);
}

template <int kBytes>
TRICUE_INLINE void across_three_by(const AcrossFilters* rows, int count, const TapView& taps, int n) {
    filter_rows_across<kBytes, true>(rows, count, taps, n);
}

template <int kBytes>
TRICUE_INLINE void across_two_by(const AcrossFilters* rows, int count, const TapView& taps, int n) {
    filter_rows_across<kBytes, false>(rows, count, taps, n);
}

TRICUE_MULTIWIDTH(across_three, across_three_by,
                  (const AcrossFilters* rows, int count, const TapView& taps, int n), (rows, count, taps, n))
TRICUE_MULTIWIDTH(across_two, across_two_by,
                  (const AcrossFilters* rows, int count, const TapView& taps, int n), (rows, count, taps, n))

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

void filter_across(const AcrossFilters* rows, int count, const GaussianTaps& taps, int n) {
    if (count > 0 && rows[0].curvature != nullptr)
        across_three(rows, count, taps.view(), n);
    else
        across_two(rows, count, taps.view(), n);
}

}  // namespace tricue
