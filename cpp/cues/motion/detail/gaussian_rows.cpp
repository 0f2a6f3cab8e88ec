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

constexpr double kReach = 3.5;  // sigmas on each side, up to the outer edge of the last pixel

TRICUE_INLINE void sum_and_difference(const float* before, const float* after, RowBlock& sum,
                                      RowBlock& difference) {
    RowBlock left, right;
    load(before, left);
    load(after, right);
    sum = {right.a + left.a, right.b + left.b};
    difference = {right.a - left.a, right.b - left.b};
}

template <bool kCurved>
TRICUE_INLINE void across(const float* row, int radius, const float* bells, const float* slopes,
                          const float* curves, int n, float* bell, float* slope, float* curve) {
    for (int x = 0; x < n; x += kRowBlock) {
        RowBlock middle, smooth{}, rise{}, bend{}, sum, difference;
        load(row + x, middle);
        add(bells[0], middle, smooth);
        if (kCurved) add(curves[0], middle, bend);
        for (int k = 1; k <= radius; ++k) {
            sum_and_difference(row + x - k, row + x + k, sum, difference);
            add(bells[k], sum, smooth);
            add(slopes[k], difference, rise);
            if (kCurved) add(curves[k], sum, bend);
        }
        store(smooth, bell + x);
        store(rise, slope + x);
        if (kCurved) store(bend, curve + x);
    }
}

template <bool kOdd>
TRICUE_INLINE void down(const float* const* rows, int radius, const float* weights, int n, float* out) {
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
void across_three(const float* row, int radius, const float* bells, const float* slopes, const float* curves,
                  int n, float* bell, float* slope, float* curve) {
    across<true>(row, radius, bells, slopes, curves, n, bell, slope, curve);
}

TRICUE_MULTIVERSION
void across_two(const float* row, int radius, const float* bells, const float* slopes, int n, float* bell,
                float* slope) {
    across<false>(row, radius, bells, slopes, nullptr, n, bell, slope, nullptr);
}

TRICUE_MULTIVERSION
void even_down(const float* const* rows, int radius, const float* weights, int n, float* out) {
    down<false>(rows, radius, weights, n, out);
}

TRICUE_MULTIVERSION
void odd_down(const float* const* rows, int radius, const float* weights, int n, float* out) {
    down<true>(rows, radius, weights, n, out);
}

/// Where a cache line begins: registers that reach over the end of one take twice as long to load.
float* aligned(std::vector<float>& data) {
    void* begin = data.data();
    std::size_t room = data.size() * sizeof data[0];
    return static_cast<float*>(std::align(kRowBlock * sizeof data[0], 1, begin, room));
}

int radius_of(const std::vector<float>& weights) {
    return static_cast<int>(weights.size()) - 1;
}

}  // namespace

GaussianTaps::GaussianTaps(double sigma) : radius(static_cast<int>(std::ceil(kReach * sigma - 0.5))) {
    std::vector<double> samples(static_cast<std::size_t>(radius) + 1);
    for (auto* weights : {&bell, &slope, &curve}) weights->reserve(samples.size());
    double sum = 0, square = 0, fourth = 0;  // of the samples on both sides, times x^0, x^2, x^4
    for (int x = 0; x <= radius; ++x) {
        const double bell_here = std::exp(-x * x / (2 * sigma * sigma)), sides = x == 0 ? 1 : 2;
        samples[static_cast<std::size_t>(x)] = bell_here;
        sum += sides * bell_here;
        square += sides * bell_here * x * x;
        fourth += sides * bell_here * x * x * x * x;
    }
    square /= sum;
    fourth /= sum;
    for (int x = 0; x <= radius; ++x) {
        const double share = samples[static_cast<std::size_t>(x)] / sum;
        bell.push_back(static_cast<float>(share));
        slope.push_back(static_cast<float>(x * share / square));
        curve.push_back(static_cast<float>(2 * (x * x - square) * share / (fourth - square * square)));
    }
}

void require_sigma(double sigma) {
    if (!(sigma >= 0.5 && sigma <= 16)) refuse("sigma", "0.5 to 16 pixels", sigma);
}

void filter_across(const float* row, const GaussianTaps& taps, int n, float* bell, float* slope,
                   float* curve) {
    across_three(row, taps.radius, taps.bell.data(), taps.slope.data(), taps.curve.data(), n, bell, slope,
                 curve);
}

void filter_across(const float* row, const GaussianTaps& taps, int n, float* bell, float* slope) {
    across_two(row, taps.radius, taps.bell.data(), taps.slope.data(), n, bell, slope);
}

void filter_down(const float* const* rows, const std::vector<float>& weights, int n, float* out) {
    even_down(rows, radius_of(weights), weights.data(), n, out);
}

void slope_down(const float* const* rows, const std::vector<float>& weights, int n, float* out) {
    odd_down(rows, radius_of(weights), weights.data(), n, out);
}

RowRing::RowRing(int count, int length)
    : count_(count),
      data_(static_cast<std::size_t>(whole_blocks(length)) * static_cast<std::size_t>(count) + kRowBlock) {
    float* first = aligned(data_);
    rows_.reserve(2 * static_cast<std::size_t>(count));
    for (int i = 0; i < 2 * count; ++i)
        rows_.push_back(first + std::ptrdiff_t{i % count} * whole_blocks(length));
}

}  // namespace tricue
