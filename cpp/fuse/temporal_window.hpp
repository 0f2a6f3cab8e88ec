// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/depth_pixels.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

struct TemporalWindow {
    Region box;          ///< all 0 where nothing is left
    std::int64_t count;  ///< pixels left
    Labels mask;         ///< H x W: 1 for pixels left, else 0
};

/// What is left of a frame's target pixels, and the rectangle round it, the temporal target window.
///
/// A pixel is left if at least `neighbours` of the 8 round it are set, none beyond the edge, and if of those it belongs to a region
/// (8 neighbours) of at least `share` times the largest one's pixels. Of the n pixels left the box leaves out floor(trim n) at
/// its left, and as many right, above and below: [x0, x1) is from the floor(trim n)-th column, in order, to that many from the last.
///
/// @param mask       (H, W), pixels that aren't 0 are set
/// @param neighbours 0 to 8
/// @param share      in [0, 1]
/// @param trim       in [0, 0.5)
/// @throws std::invalid_argument on other numbers
/// Source: Okada, Shirai, Miura 1996, section 4 and figure 4; the clean-up and the trimmed edges are ours.
TemporalWindow temporal_window(const ImageView& mask, int neighbours, double share, double trim);

}  // namespace tricue
