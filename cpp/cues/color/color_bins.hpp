// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/image_view.hpp"
#include "base/region.hpp"
#include "cues/color/detail/bins_view.hpp"
#include "cues/color/detail/color_space.hpp"

namespace tricue {

/// A bin for every pixel of a region, (H, W).
using Bins = Eigen::Array<std::uint16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The bin of every pixel of a region in the space (B - G, G - R, B + G + R).
///
/// Whole numbers throughout: an axis of n bins over L levels has level v in bin floor(v n / L). With a step of s the pixel
/// (x0 + s j + s / 2, y0 + s i + s / 2) alone stands for the s x s pixels round it, and place x of the image is (x - x0) / s here.
///
/// @param image  uint8 BGR, may be empty
/// @param region may reach over the edge; a side is at most 32768 pixels
/// @param space  bins an axis, and where the axes of chroma end
/// @param step   pixels from one to the next, 1 to 1024
/// @returns      (ceil(height / step), ceil(width / step)); kNoBin outside the image; empty for an empty region
/// @throws std::invalid_argument on other values
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.1, after Birchfield 1998; they don't say where the axes end.
Bins color_bins(const ImageView& image, const Region& region, const ColorSpace& space, int step);

}  // namespace tricue
