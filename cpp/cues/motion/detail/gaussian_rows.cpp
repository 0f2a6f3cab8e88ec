// SPDX-License-Identifier: MIT
#include "cues/motion/detail/gaussian_rows.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/motion/detail/row_block.hpp"

namespace tricue {
namespace {

constexpr double kSupportSigmas = 3.5;  // sigmas on each side, up to the outer edge of the last pixel

TRICUE_INLINE void sum_and_difference(const float* before, const float* after, RowBlock& sum,
                                      RowBlock& difference) {
    RowBlock left, right;
    load(before, left);
    load(after, right);
    sum = {right.a + left.a, right.b + left.b};
    difference = {right.a - left.a, right.b - left.b};
}

template <bool kWithCurvature>
TRICUE_INLINE void filter_across_by(const float* row, int radius, const float* smooth_weights,
                                    const float* slope_weights, const float* curvature_weights, int n,
                                    float* smooth, float* slope, float* curvature) {
    for (int x = 0; x < n; x += kRowBlock) {
        RowBlock middle, smooth_sum{}, slope_sum{}, curvature_sum{}, sum, difference;
        load(row + x, middle);
        add(smooth_weights[0], middle, smooth_sum);
        if (kWithCurvature) add(curvature_weights[0], middle, curvature_sum);
        for (int k = 1; k <= radius; ++k) {
            sum_and_difference(row + x - k, row + x + k, sum, difference);
            add(smooth_weights[k], sum, smooth_sum);
            add(slope_weights[k], difference, slope_sum);
            if (kWithCurvature) add(curvature_weights[k], sum, curvature_sum);
        }
        store(smooth_sum, smooth + x);
        store(slope_sum, slope + x);
        if (kWithCurvature) store(curvature_sum, curvature + x);
    }
}

template <bool kOdd>
TRICUE_INLINE void filter_down_by(const float* const* rows, int radius, const float* weights, int n,
                                  float* out) {
    for (int x = 0; x < n; x += kRowBlock) {
        RowBlock middle, total{}, sum, difference;
        load(rows[radius] + x, middle);
        if (!kOdd) add(weights[0], middle, total);
        for (int k = 1; k <= radius; ++k) {
            sum_and_difference(rows[radius - k] + x, rows[radius + k] + x, sum, difference);
            add(weights[k], kOdd ? difference : sum, total);
        }
        store(total, out + x);
    }
}

TRICUE_MULTIVERSION
void across_three(const float* row, int radius, const float* smooth_weights, const float* slope_weights,
                  const float* curvature_weights, int n, float* smooth, float* slope, float* curvature) {
    filter_across_by<true>(row, radius, smooth_weights, slope_weights, curvature_weights, n, smooth, slope,
                           curvature);
}

TRICUE_MULTIVERSION
void across_two(const float* row, int radius, const float* smooth_weights, const float* slope_weights, int n,
                float* smooth, float* slope) {
    filter_across_by<false>(row, radius, smooth_weights, slope_weights, nullptr, n, smooth, slope, nullptr);
}

TRICUE_MULTIVERSION
void even_down(const float* const* rows, int radius, const float* weights, int n, float* out) {
    filter_down_by<false>(rows, radius, weights, n, out);
}

TRICUE_MULTIVERSION
void odd_down(const float* const* rows, int radius, const float* weights, int n, float* out) {
    filter_down_by<true>(rows, radius, weights, n, out);
}

/// The first cache line: loads that cross a line take twice as long.
float* aligned(std::vector<float>& data) {
    void* begin = data.data();
    std::size_t room = data.size() * sizeof data[0];
    return static_cast<float*>(std::align(kRowBlock * sizeof data[0], 1, begin, room));
}

int radius_of(const std::vector<float>& weights) {
    return static_cast<int>(weights.size()) - 1;
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
    across_three(row, taps.radius, taps.smooth.data(), taps.slope.data(), taps.curvature.data(), n, smooth,
                 slope, curvature);
}

void filter_across(const float* row, const GaussianTaps& taps, int n, float* smooth, float* slope) {
    across_two(row, taps.radius, taps.smooth.data(), taps.slope.data(), n, smooth, slope);
}

void filter_down(const float* const* rows, const std::vector<float>& weights, int n, float* out) {
    even_down(rows, radius_of(weights), weights.data(), n, out);
}

void slope_down(const float* const* rows, const std::vector<float>& weights, int n, float* out) {
    odd_down(rows, radius_of(weights), weights.data(), n, out);
}

RowRingBuffer::RowRingBuffer(int count, int length)
    : count_(count),
      data_(static_cast<std::size_t>(whole_blocks(length)) * static_cast<std::size_t>(count) + kRowBlock) {
    float* first = aligned(data_);
    rows_.reserve(2 * static_cast<std::size_t>(count));
    for (int i = 0; i < 2 * count; ++i)
        rows_.push_back(first + std::ptrdiff_t{i % count} * whole_blocks(length));
}

}  // namespace tricue
