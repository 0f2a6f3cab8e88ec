// SPDX-License-Identifier: MIT
#include "fuse/block_counts.hpp"

#include <vector>

#include "base/check.hpp"
#include "fuse/detail/count_blocks.hpp"
#include "fuse/detail/rectangle_pixels.hpp"

namespace tricue {

BlockCounts block_counts(const ImageView& mask, const PlaneView& disparity, StatesRef blocks, float expected,
                         float tolerance) {
    require_same_shape(mask, disparity, "mask");
    require_shape(blocks, blocks.rows(), 4, "blocks");
    std::vector<Region> parts;
    for (Eigen::Index i = 0; i < blocks.rows(); ++i) {
        const auto block = blocks.row(i);
        parts.push_back(rectangle_pixels({block[0], block[1], block[2], block[3]}, disparity.rows,
                                         disparity.cols, "blocks"));
    }
    return count_blocks(mask, disparity, parts, expected, tolerance);
}

}  // namespace tricue
