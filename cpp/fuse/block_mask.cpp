// SPDX-License-Identifier: MIT
#include "fuse/block_mask.hpp"

#include <algorithm>
#include <cstdint>

#include "base/check.hpp"
#include "fuse/detail/rectangle_pixels.hpp"

namespace tricue {

Labels block_mask(StatesRef blocks, int height, int width) {
    require_count(height, 0, kMaxImageSide, "height");
    require_count(width, 0, kMaxImageSide, "width");
    require_shape(blocks, blocks.rows(), 4, "blocks");
    Labels mask = Labels::Zero(height, width);
    for (Eigen::Index i = 0; i < blocks.rows(); ++i) {
        const auto block = blocks.row(i);
        const Region part =
            rectangle_pixels({block[0], block[1], block[2], block[3]}, height, width, "blocks");
        for (int y = part.y0; y < part.y1; ++y)
            std::fill(mask.row(y).data() + part.x0, mask.row(y).data() + part.x1, std::uint8_t{1});
    }
    return mask;
}

}  // namespace tricue
