// SPDX-License-Identifier: MIT
#include "cues/motion/detail/flow_constraints.hpp"

#include <array>

#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void mean_and_change(const float* __restrict before, const float* __restrict now, int n,
                     float* __restrict mean, float* __restrict change) {
    for_overlapping_blocks<16>(n, [=](std::ptrdiff_t x) {
        mean[x] = 0.5F * (before[x] + now[x]);
        change[x] = now[x] - before[x];
    });
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
    const float *smooth = taps_.smooth.data(), *slope = taps_.slope.data(),
                *curvature = taps_.curvature.data();
    const std::array<ColumnFilter, 5> filters{{{around(mean_curvature_), smooth, false, result_.row(0)},
                                               {around(mean_slope_), slope, true, result_.row(1)},
                                               {around(mean_smooth_), curvature, false, result_.row(2)},
                                               {around(change_slope_), smooth, false, result_.row(3)},
                                               {around(change_smooth_), slope, true, result_.row(4)}}};
    filter_down(filters.data(), 5, taps_.radius, length_);
    return {result_.row(0), result_.row(1), result_.row(2), result_.row(3), result_.row(4)};
}

}  // namespace tricue
