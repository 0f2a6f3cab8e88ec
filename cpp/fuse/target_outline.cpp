// SPDX-License-Identifier: MIT
#include "fuse/target_outline.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr double kTrim = 0.02;  // share of the pixels that the box leaves out on each side

/// Clears the pixels in `mine` that are neither target pixels nor near the target's disparity.
TRICUE_MULTIVERSION
void keep_near(const std::uint8_t* __restrict mask, const float* __restrict disparity, float target,
               float tolerance, int n, std::uint8_t* __restrict mine) {
    for_overlapping_blocks<16>(n, [=](std::ptrdiff_t x) {
        const bool near = std::abs(disparity[x] - target) <= tolerance;
        mine[x] = (mine[x] != 0) & ((mask[x] != 0) | near);
    });
}

}  // namespace

TemporalWindow target_outline(const ImageView& mask, const PlaneView& disparity, const BlockGrid& grid,
                              BlockNumbers states, float target, float tolerance) {
    require_same_shape(mask, disparity, "mask");
    require_numbers(grid, states, "states");
    const std::vector<Region> blocks = block_pixels(grid, mask.rows, mask.cols);
    std::vector<Region> own;
    for (Eigen::Index i = 0; i < states.size(); ++i)
        if (states[i] == 1) own.push_back(blocks[static_cast<std::size_t>(i)]);
    Labels mine = mask_regions(own, mask.rows, mask.cols);
    for (int y = 0; y < mask.rows; ++y)
        keep_near(mask.row(y), disparity.row(y), target, tolerance, mask.cols, mine.row(y).data());
    return temporal_window({mine.data(), mask.rows, mask.cols, 1, mask.cols}, 0, 0.0, kTrim);
}

}  // namespace tricue
