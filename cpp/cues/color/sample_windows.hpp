// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// The bytes of N windows' samples, sample by sample, row by row, window by window.
using WindowBytes = Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>;

/// Resamples windows of an image on one grid, smoothed where they have more detail than the grid can hold.
///
/// Along an axis a sample that covers `step` pixels is the mean of t = ceil(step) evenly spaced bilinear readings, at least 1 and
/// at most 4: windows sampled more coarsely than every fourth pixel alias. Reading j is at start + (j + 1/2) step / t - 1/2, (0,
/// 0) being the center of the first pixel, in float64, clamped to the image, and rounded half up to 1/64 pixel. Means are rounded
/// half up; the order of summation doesn't change a bit.
///
/// Cost grows with rows times the windows' widths in pixels, which are read whole.
///
/// @param image uint8 (H, W, 3) BGR or (H, W) gray, at least one pixel
/// @param windows float64 (N, 4): left, top, width, height, pixels, whose edges are at whole numbers; finite, sizes above 0
/// @param rows of the grid, 1 to 16384
/// @param columns of the grid, 1 to 16384
/// @returns uint8 (N, rows, columns, 3) BGR, of a gray image (N, rows, columns); in C++ one array of bytes in this order
/// @throws std::invalid_argument on other shapes, an image without pixels, or numbers out of range
/// Source: ours; bilinear readings that cover the sample, as in mipmaps and OpenCV's INTER_AREA.
WindowBytes sample_windows(const ImageView& image, StatesRef windows, int rows, int columns);

}  // namespace tricue
