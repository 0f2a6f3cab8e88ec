// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/sample_windows.hpp"

namespace tricue {

/// Resamples turned or sheared windows of an image on one grid, smoothed where they have more detail than the grid can hold.
///
/// A sample is the mean of the image over an upright square around its place. The square's side is the step between samples in
/// pixels, that of the axis with the shorter step, rounded half up, at least 1, at most 4, and less than the image's sides. So
/// windows sampled more coarsely than every fourth pixel alias. The square's upper left corner, in float64, is moved so that the
/// square is in the image, and rounded half up to 1/16 pixel. Means are rounded half up; the order of summation doesn't change a
/// bit. If the image has one row or column, it is repeated.
///
/// Cost grows with the number of samples, whatever the windows' size.
///
/// @param image uint8 (H, W, 3) BGR, at least one pixel
/// @param windows float64 (N, 6): x, y of the center, the vector along the upper side, to the right, and that along the left
///     side, down; pixels, whose edges are at whole numbers; finite, vectors not 0
/// @param rows of the grid, 1 to 16384
/// @param columns of the grid, 1 to 16384
/// @returns uint8 (N, rows, columns, 3) BGR; in C++ one array of bytes in this order
/// @throws std::invalid_argument on other shapes, an image without pixels, or numbers out of range
/// Source: ours; with a square of one pixel it is bilinear interpolation.
WindowBytes sample_turned_windows(const ImageView& image, StatesRef windows, int rows, int columns);

}  // namespace tricue
