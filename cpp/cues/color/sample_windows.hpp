// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// The bytes of N windows' samples, BGR, sample by sample, row by row, window by window.
using WindowBytes = Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>;

/// Windows of an image on one grid of samples, smoothed where they have more detail than the grid can hold.
///
/// Along each axis a sample of `step` pixels has t = ceil(step) readings, at least 1 and at most 4, evenly spaced: so windows that are
/// sampled more coarsely than every fourth pixel alias, and cost no more. A sample is the mean of its t_y x t_x bilinear readings, rounded
/// half up. Reading j of an axis is at start + (j + 1/2) step / t - 1/2, (0, 0) being the centre of the first pixel, computed in
/// float64, moved into the image (so its edge is repeated), and rounded half up to 1/64 pixel: then all sums are of integers that
/// float32 holds exactly, and no order of summation changes a bit.
///
/// Cost grows with rows times the pixels of the windows' widths, which are read whole.
///
/// @param image   uint8 BGR, at least one pixel
/// @param windows N x 4: left, top, width, height in pixels, a pixel's edges being at whole numbers; finite, sizes above 0
/// @param rows    of the grid, at least 1
/// @param columns of the grid, at least 1
/// @throws std::invalid_argument on another shape, an image without pixels, and numbers out of range
/// Source: ours; bilinear readings that cover the sample, as mipmaps and INTER_AREA have.
WindowBytes sample_windows(const ImageView& image, StatesRef windows, int rows, int columns);

}  // namespace tricue
