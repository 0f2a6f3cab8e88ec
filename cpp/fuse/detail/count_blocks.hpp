// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "base/region.hpp"
#include "fuse/block_counts.hpp"

namespace tricue {

/// What is seen in regions of a mask and of the disparities, of one shape, as block_counts counts it.
BlockCounts count_blocks(const ImageView& mask, const PlaneView& disparity, const std::vector<Region>& blocks,
                         float expected, float tolerance);

}  // namespace tricue
