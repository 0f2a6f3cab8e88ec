// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Reads the same n places of every ellipse: pixel (floor(y + major v), floor(x + minor u)) for each (u, v) of the pattern.
///
/// Nearest pixels, never a mixture of neighbors, so that an increasing change of a channel keeps the order of its samples. A place
/// outside the image reads the nearest pixel inside. Places are float32: x + minor u, rounded twice.
///
/// @param image uint8 (H, W, 3) BGR, at least one pixel, 2 GB at most
/// @param ellipses float64 (N, 4): center x, y, semi-axes along x (minor) and y (major), pixels, finite
/// @param pattern float64 (n, 2): (u, v) in semi-axes, (0, 0) the center, u² + v² = 1 the outline; finite
/// @param[out] samples uint8 (N, 3, n): planes of blue, green and red
/// @returns uint8 (N, 3, n): N ellipses, channels B, G, R
/// @throws std::invalid_argument on other shapes, an image without pixels, or numbers that are not finite
/// Source: the window whose pixels are ranked, Sabeti, Parvizi, Wu 2008, section III.B.
void sample_ellipses(const ImageView& image, StatesRef ellipses, StatesRef pattern, std::uint8_t* samples);

}  // namespace tricue
