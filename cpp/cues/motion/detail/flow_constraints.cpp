// SPDX-License-Identifier: MIT
#include "cues/motion/detail/flow_constraints.hpp"

#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void mean_and_change(const float* __restrict before, const float* __restrict now, int n,
                     float* __restrict mean, float* __restrict change) {
    for (int x = 0; x < n; ++x) {
        mean[x] = 0.5F * (before[x] + now[x]);
        change[x] = now[x] - before[x];
    }
}

}  // namespace

ConstraintRows::ConstraintRows(double sigma, int length)
    : taps_(sigma),
      length_(length),
      mean_(static_cast<std::size_t>(whole_blocks(length) + 2 * taps_.radius)),
      change_(mean_.size()),
      mean_smooth_(2 * taps_.radius + 1, length),
      mean_slope_(2 * taps_.radius + 1, length),
      mean_curvature_(2 * taps_.radius + 1, length),
      change_smooth_(2 * taps_.radius + 1, length),
      change_slope_(2 * taps_.radius + 1, length),
      result_(5, length) {}

void ConstraintRows::push(int y, const float* before, const float* now) {
    mean_and_change(before, now, length_ + 2 * taps_.radius, mean_.data(), change_.data());
    filter_across(mean_.data() + taps_.radius, taps_, length_, mean_smooth_.row(y), mean_slope_.row(y),
                  mean_curvature_.row(y));
    filter_across(change_.data() + taps_.radius, taps_, length_, change_smooth_.row(y), change_slope_.row(y));
}

Constraints ConstraintRows::row(int y) {
    const auto around = [&](const RowRingBuffer& ring) { return ring.from(y - taps_.radius); };
    filter_down(around(mean_curvature_), taps_.smooth, length_, result_.row(0));
    slope_down(around(mean_slope_), taps_.slope, length_, result_.row(1));
    filter_down(around(mean_smooth_), taps_.curvature, length_, result_.row(2));
    filter_down(around(change_slope_), taps_.smooth, length_, result_.row(3));
    slope_down(around(change_smooth_), taps_.slope, length_, result_.row(4));
    return {result_.row(0), result_.row(1), result_.row(2), result_.row(3), result_.row(4)};
}

}  // namespace tricue
