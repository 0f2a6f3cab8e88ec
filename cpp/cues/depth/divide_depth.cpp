// SPDX-License-Identifier: MIT
#include "cues/depth/divide_depth.hpp"

#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

void require_dividers(VectorRef dividers) {
    const auto count = dividers.size();
    if (count < 2 || count > 256) refuse("dividers", "2 to 256 numbers", std::to_string(count));
    require_finite(dividers, "dividers");
    for (Eigen::Index k = 1; k < count; ++k)
        if (dividers[k] < dividers[k - 1]) refuse("dividers", "ascending numbers", dividers[k]);
}

/// Overwrites labels in the order of the dividers, which ascend: a depth keeps the label of the last divider that it reaches.
TRICUE_MULTIVERSION
void divide_row(const float* __restrict depth, const std::uint8_t* __restrict mask, int n,
                const float* __restrict dividers, int divisions, std::uint8_t* __restrict labels) {
    const float first = dividers[0], end = dividers[divisions];
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) { labels[x] = depth[x] >= first; });
    for (int k = 1; k < divisions; ++k) {
        const float least = dividers[k];
        const auto label = static_cast<std::uint8_t>(k + 1);
        for_overlapping_blocks(n,
                               [=](std::ptrdiff_t x) { labels[x] = depth[x] >= least ? label : labels[x]; });
    }
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) {
        const bool inside = has_depth(depth[x]) & (mask[x] != 0) & (depth[x] < end);
        labels[x] = inside ? labels[x] : std::uint8_t{0};
    });
}

}  // namespace

Labels divide_depth(const DepthView& depth, const ImageView& mask, VectorRef dividers) {
    require_same_shape(mask, depth, "mask");
    require_dividers(dividers);
    std::vector<float> floats;
    for (const double s : dividers) floats.push_back(round_up_to_float(s));
    const int divisions = static_cast<int>(floats.size()) - 1;
    Labels labels(depth.rows, depth.cols);
    for (int y = 0; y < depth.rows; ++y)
        divide_row(depth.row(y), mask.row(y), depth.cols, floats.data(), divisions,
                   labels.data() + std::ptrdiff_t{y} * depth.cols);
    return labels;
}

}  // namespace tricue
