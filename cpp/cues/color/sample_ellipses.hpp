// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Reads the same n places of every ellipse: pixel (floor(y + major v), floor(x + minor u)) for each (u, v) of the pattern.
///
/// Nearest pixels, never a mixture of neighbours, so that any increasing change of a channel keeps the order of its samples.
/// A place outside the image reads the nearest pixel inside. Places are computed in float32: x + minor u, rounded twice.
///
/// @param image    uint8 BGR, at least one pixel
/// @param ellipses N x 4: centre x, y, semi-axes along x (minor) and along y (major), pixels, finite
/// @param pattern  n x 2: (u, v) in semi-axes, (0, 0) the centre, u² + v² = 1 the outline; finite
/// @param samples  out, N x 3 x n: planes of blue, green and red
/// @throws std::invalid_argument on another shape, an image without pixels, or numbers that aren't finite
/// Source: the window whose pixels are ranked, Sabeti, Parvizi, Wu 2008, section III.B.
void sample_ellipses(const ImageView& image, StatesRef ellipses, StatesRef pattern, std::uint8_t* samples);

}  // namespace tricue
