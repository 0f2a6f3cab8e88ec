// SPDX-License-Identifier: MIT
#pragma once

#include "base/image_view.hpp"

namespace tricue {

/// Reference color c0 of a skin patch: the color that appears most in it.
///
/// The paper takes the mode (3), which is noise over a small patch of 8-bit colors. Here it is the mode of the joint histogram of
/// 32 levels per channel, then the mean of the patch's pixels in that cell, rounded half up. Of cells that are equally full the
/// first in the order of blue, green, red wins.
///
/// @param patch uint8 (H, W, 3) BGR, at least one pixel
/// @returns uint8 (3,): B, G, R
/// @throws std::invalid_argument on an empty patch
/// Source: Sabeti, Parvizi, Wu 2008, section III.A, equation (3).
Bgr skin_reference(const ImageView& patch);

}  // namespace tricue
