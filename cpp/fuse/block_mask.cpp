// SPDX-License-Identifier: MIT
#include "fuse/block_mask.hpp"

#include "base/check.hpp"
#include "fuse/detail/block_grid.hpp"
#include "fuse/detail/rectangle_pixels.hpp"

namespace tricue {

Labels block_mask(StatesRef blocks, int height, int width) {
    require_count(height, 0, kMaxImageSide, "height");
    require_count(width, 0, kMaxImageSide, "width");
    return mask_regions(rectangle_pixels(blocks, height, width, "blocks"), height, width);
}

}  // namespace tricue
