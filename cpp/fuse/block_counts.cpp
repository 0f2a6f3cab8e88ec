// SPDX-License-Identifier: MIT
#include "fuse/block_counts.hpp"

#include "base/check.hpp"
#include "fuse/detail/count_blocks.hpp"
#include "fuse/detail/rectangle_pixels.hpp"

namespace tricue {

BlockCounts block_counts(const ImageView& mask, const PlaneView& disparity, StatesRef blocks, float expected,
                         float tolerance) {
    require_same_shape(mask, disparity, "mask");
    const auto regions = rectangle_pixels(blocks, disparity.rows, disparity.cols, "blocks");
    return count_blocks(mask, disparity, regions, expected, tolerance);
}

}  // namespace tricue
