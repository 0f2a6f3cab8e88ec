// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/depth_pixels.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

struct TemporalWindow {
    Region box;          ///< (x0, y0, x1, y1), pixels; all 0 where nothing is kept
    std::int64_t count;  ///< number of pixels kept
    Labels mask;         ///< uint8 (H, W): 1 for pixels kept, else 0
};

/// Cleans the target pixels of a frame, and finds the box around them: the temporal target window.
///
/// A set pixel is kept if at least `neighbors` of the 8 around it are set (none beyond the edge is), and if its region of such
/// pixels (8 neighbors) has at least `share` times the pixels of the largest. Of the n pixels kept, the box leaves out floor(trim
/// n) at its left, and as many at its right, above and below: with these pixels in the order of their columns, [x0, x1) goes from
/// the column of number floor(trim n), counted from 0, to that of the one with as many after it.
///
/// @param mask uint8 (H, W): pixels that are not 0 are set
/// @param neighbors 0 to 8
/// @param share in [0, 1]
/// @param trim in [0, 0.5)
/// @throws std::invalid_argument on numbers out of range
/// Source: Okada, Shirai, Miura 1996, section 4 and figure 4; the clean-up and the trimmed edges are ours.
TemporalWindow temporal_window(const ImageView& mask, int neighbors, double share, double trim);

}  // namespace tricue
