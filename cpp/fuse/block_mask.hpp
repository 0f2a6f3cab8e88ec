// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_pixels.hpp"

namespace tricue {

/// Rasterizes the blocks of the target, in which its histograms are taken.
///
/// @param blocks float64 (N, 4): x0, y0, x1, y1, pixels, finite, as in block_counts; they may overlap, and extend beyond the mask
/// @param height, width of the mask, pixels, 0 to 16384
/// @returns uint8 (height, width): 1 in the pixels of any block, else 0
/// @throws std::invalid_argument on blocks of another shape, corners that are not finite, or sizes out of range
/// Source: Okada, Shirai, Miura 1996, section 4.4 and figure 7.
Labels block_mask(StatesRef blocks, int height, int width);

}  // namespace tricue
