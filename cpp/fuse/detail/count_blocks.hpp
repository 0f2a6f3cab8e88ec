// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/region.hpp"
#include "fuse/block_counts.hpp"

namespace tricue {

/// The counts of block_counts for regions of a mask and of disparities of the same shape.
BlockCounts count_blocks(const ImageView& mask, const PlaneView& disparity, const std::vector<Region>& blocks,
                         float expected, float tolerance);

}  // namespace tricue
