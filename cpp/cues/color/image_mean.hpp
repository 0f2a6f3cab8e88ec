// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// The mean color of an image, or of some of its rows: a measure of the light while the scene stays the same.
///
/// @param image uint8 (H, W, 3) BGR
/// @returns float64 (3,): blue, green and red; 0 where there is no pixel
/// Source: ours, for von Kries' adaptation to the light.
Vector image_mean(const ImageView& image);

}  // namespace tricue
