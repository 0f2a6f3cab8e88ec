// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

/// Gray levels, (H, W).
using GrayImage = Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The mean gray levels of an image in cells of step x step pixels; a color image is first turned gray.
///
///     gray = (3735 B + 19235 G + 9798 R + 2^14) >> 15
///
/// Rows and columns that don't fill a cell are left out. Means are rounded half to even, those of 2 x 2 pixels half up, as by
/// OpenCV.
///
/// @param image uint8 (H, W, 3) BGR, or gray (H, W)
/// @param step side of a cell, pixels, 1 to the smaller side of the image
/// @param region (x0, y0, x1, y1), cells, inside the result: those that are computed; all others are 0; None for all
/// @returns uint8 (H // step, W // step), never the image's own memory
/// @throws std::invalid_argument on a step or a region out of range
/// Source: ITU-R BT.601's luma, in OpenCV's whole numbers.
GrayImage reduce_gray(const ImageView& image, int step, const std::optional<Region>& region = {});

}  // namespace tricue
