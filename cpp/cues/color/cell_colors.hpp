// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "base/image_view.hpp"

namespace tricue {

/// The colors of cells and their mean.
struct CellColors {
    /// uint8 (ceil((H - step // 2) / step), the same of W, 3): the color of each cell's middle pixel, BGR
    Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> colors;
    /// float64 (3,) blue, green and red: a measure of the light while the scene stays the same; 0 of an empty image
    std::array<double, 3> mean;
};

/// Every step-th pixel of an image, from step // 2 on, and their mean.
///
/// @param image uint8 (H, W, 3) BGR
/// @param step pixels from one sample to the next, 1 to 1024
/// @throws std::invalid_argument on a step out of range
/// Source: ours, for Moreno et al. 2002, whose images are 160x120 already; the mean is for von Kries' adaptation to the light.
CellColors cell_colors(const ImageView& image, int step);

}  // namespace tricue
