// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "base/image_view.hpp"
#include "base/region.hpp"
#include "cues/color/detail/bins_view.hpp"
#include "cues/color/detail/color_space.hpp"

namespace tricue {

/// A bin for every pixel of a region, (H, W).
using Bins = Eigen::Array<std::uint16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The bin of each pixel of a region in the color space (B - G, G - R, B + G + R).
///
/// Bin (i, j, k) has the index (i n_1 + j) n_2 + k. An axis of n bins over L whole levels puts level v into bin floor(v n / L).
/// With step s, output (i, j) reads only pixel (x0 + s j + s // 2, y0 + s i + s // 2), so coordinate x of the image is (x - x0) /
/// s in the output.
///
/// @param image uint8 (H, W, 3) BGR, may be empty
/// @param region (x0, y0, x1, y1), pixels; may extend beyond the image; sides of at most 32768
/// @param step pixels from one sample to the next, 1 to 1024
/// @param gains factors (3,) of blue, green and red that turn the colors into those of another light (von Kries), finite, 0 or
///     more; products are rounded half to even and clamped to 255; None for 1
/// @returns uint16 (ceil(height / step), ceil(width / step)); 65535 outside the image; empty for an empty region
/// @throws std::invalid_argument on values out of range
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.1, after Birchfield 1998; neither gives the ranges of the
/// axes.
Bins color_bins(const ImageView& image, const Region& region, const ColorSpace& space, int step,
                const std::array<double, 3>* gains);

}  // namespace tricue
