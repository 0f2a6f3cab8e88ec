// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_pixels.hpp"

namespace tricue {

/// Which pixels the blocks of the target have: where its histograms are taken, and what lies round it isn't.
///
/// @param blocks (N, 4) x0, y0, x1, y1: of a block are the pixels whose centres lie in it (camera/rectangle.hpp), as in block_counts;
///               blocks may overlap, and reach over the edge
/// @param height, width pixels, at least 0
/// @returns      H x W: 1 in a pixel of any block, else 0
/// @throws std::invalid_argument on blocks of another shape or that aren't finite, and a negative size
/// Source: Okada, Shirai, Miura 1996, section 4.4 and figure 7.
Labels block_mask(StatesRef blocks, int height, int width);

}  // namespace tricue
