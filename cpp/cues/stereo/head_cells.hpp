// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "base/image_view.hpp"
#include "base/region.hpp"
#include "cues/color/color_bins.hpp"
#include "cues/stereo/detail/coherent_cells.hpp"
#include "cues/stereo/sad_disparity.hpp"

namespace tricue {

/// The conditions for a cell to be at the head's depth.
struct HeadDepth {
    float expected;   ///< the head's disparity, cells, finite
    float tolerance;  ///< largest difference of a cell's disparity from it, cells, 0 or more
    int fill;         ///< side of the square by whose majority gaps are filled, cells, odd, 1 to 127
};

struct HeadCells {
    Bins bins;          ///< uint16 (h, w), as color_bins gives them
    CellMask coherent;  ///< uint8 (h, w): 1 at the head's depth, else 0
};

/// The cells of a rectangle: the color bin of each, and whether it is at a head's depth.
///
/// A cell is step x step pixels, and has the color of its middle one (color_bins). Its disparity is found by sad_disparity
/// between the means of gray cells (reduce_gray), all lengths of the search in cells. It is at the head's depth if that
/// disparity differs from the expected one by at most the tolerance. A cell without a disparity, as in hair of one color, gets
/// the majority of the cells around it that have one; a tie counts against it. No cell outside the image is at the head's
/// depth.
///
/// @param left uint8 (H, W, 3) BGR, rectified, at least one pixel
/// @param right uint8 (H, W, 3) BGR, or gray (H, W), of the same size
/// @param region (x0, y0, x1, y1), cells, sides of 1 to 16384, and of at most 32768 pixels; may extend beyond the image
/// @param step side of a cell, pixels, 1 to 1024 and to the smaller side of the image
/// @param gains as color_bins takes them, or None
/// @throws std::invalid_argument on images of different sizes, or values out of range
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, sections 3.1 (colors) and 3.2 (disparities). Which cells are at the head's
/// depth is ours; the paper searches by colors alone.
HeadCells head_cells(const ImageView& left, const ImageView& right, const Region& region, int step,
                     const ColorSpace& space, const std::array<double, 3>* gains, const HeadDepth& depth,
                     const DisparityRange& limits, const StereoMatching& matching);

}  // namespace tricue
