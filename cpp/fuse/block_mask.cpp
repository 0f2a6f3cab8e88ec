// SPDX-License-Identifier: MIT
#include "fuse/block_mask.hpp"

#include <vector>

#include "base/check.hpp"
#include "fuse/detail/block_grid.hpp"
#include "fuse/detail/rectangle_pixels.hpp"

namespace tricue {

Labels block_mask(StatesRef blocks, int height, int width) {
    require_count(height, 0, kMaxImageSide, "height");
    require_count(width, 0, kMaxImageSide, "width");
    require_shape(blocks, blocks.rows(), 4, "blocks");
    std::vector<Region> parts;
    for (Eigen::Index i = 0; i < blocks.rows(); ++i) {
        const auto block = blocks.row(i);
        parts.push_back(rectangle_pixels({block[0], block[1], block[2], block[3]}, height, width, "blocks"));
    }
    return mask_regions(parts, height, width);
}

}  // namespace tricue
