// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/image_view.hpp"

namespace tricue {

/// The gray levels of an image, BGR or gray, in cells of step x step pixels, as defined by reduce_gray, a part of a row at a
/// time.
class GrayCells {
public:
    /// @param step 1 to the smaller side of the image
    GrayCells(const ImageView& image, int step);

    int rows() const { return image_.rows / step_; }
    int cols() const { return image_.cols / step_; }

    /// Cells [x0, x1) of a row: in the image itself if they are its pixels, else in `room`, which they then fill.
    const std::uint8_t* row(int y, int x0, int x1, std::uint8_t* room);

private:
    ImageView image_;
    int step_;
    std::vector<std::uint8_t> gray_;   ///< gray levels of the pixels in a row of cells
    std::vector<std::uint16_t> sums_;  ///< sums of the pixels' columns
};

}  // namespace tricue
