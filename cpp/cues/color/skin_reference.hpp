// SPDX-License-Identifier: MIT
#pragma once

#include "base/image_view.hpp"

namespace tricue {

/// The reference color c0 of a skin patch: the color that appears most in it.
///
/// The paper takes the mode of (3), which over a small patch of 8-bit colors is noise. Here it is the mode of
/// the joint histogram quantised to 32 levels a channel, then the mean of the patch's pixels in that cell,
/// rounded, halves up. Of cells that are equally full the first in the order of blue, green, red wins.
///
/// @param patch BGR pixels, at least one
/// @returns     blue, green, red
/// @throws std::invalid_argument on an empty patch
/// Source: Sabeti, Parvizi, Wu 2008, section III.A, equation (3).
Bgr skin_reference(const ImageView& patch);

}  // namespace tricue
