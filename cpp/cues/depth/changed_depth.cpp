// SPDX-License-Identifier: MIT
#include "cues/depth/changed_depth.hpp"

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void compare_row(const float* __restrict depth, const float* __restrict before, int n, float noise,
                 float slope, std::uint8_t* __restrict changed) {
    for_overlapping_blocks(
        n, [=](std::ptrdiff_t x) { changed[x] = has_changed(depth[x], before[x], noise, slope); });
}

}  // namespace

void require_noise(double noise, double slope) {
    require_not_negative(noise, "noise");
    require_not_negative(slope, "slope");
}

Labels changed_depth(const DepthView& depth, const DepthView& before, double noise, double slope) {
    require_same_shape(before, depth, "before");
    require_noise(noise, slope);
    Labels changed(depth.rows, depth.cols);
    for (int y = 0; y < depth.rows; ++y)
        compare_row(depth.row(y), before.row(y), depth.cols, static_cast<float>(noise),
                    static_cast<float>(slope), changed.row(y).data());
    return changed;
}

}  // namespace tricue
