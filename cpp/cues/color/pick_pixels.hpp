// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/image_view.hpp"

namespace tricue {

using PixelBytes = Eigen::Array<std::uint8_t, Eigen::Dynamic, 1>;
using PixelPlaces = Eigen::Array<std::int64_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using PlacesRef = Eigen::Ref<const PixelPlaces>;

/// An image whose pixels are those of another at given places: a map to other coordinates, such as log-polar ones, by nearest pixels.
///
/// @param image uint8 (H, W, 3) BGR, without padding between its rows
/// @param places int64 (R, C): y W + x of each pixel, from 0 to H W - 1
/// @returns uint8 (R, C, 3); in C++ the bytes one after the other
/// @throws std::invalid_argument on a place outside of the image, or padded rows
/// Source: Reddy and Chatterji 1996, for the log-polar coordinates.
PixelBytes pick_pixels(const ImageView& image, PlacesRef places);

}  // namespace tricue
