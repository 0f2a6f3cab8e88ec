// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_pixels.hpp"
#include "base/depth_view.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// The division masks D_l in one image: the label l in 1..M where S(l) <= z < S(l + 1), 0 where there is none.
///
/// Depths are compared exactly, as the real numbers that they are. Where two dividers are equal their division is empty.
///
/// @param depth    metres; what wasn't measured gets 0
/// @param mask     of the same shape: pixels where it is 0 get 0
/// @param dividers (M + 1,): the range dividers S(1) to S(M + 1), metres, finite, ascending; 1 <= M <= 255
/// @returns        (H, W) labels
/// @throws std::invalid_argument on a mask of another shape, or dividers that are none
/// Source: Sabeti, Parvizi, Wu 2008, equations (35), (36).
Labels divide_depth(const DepthView& depth, const ImageView& mask, VectorRef dividers);

}  // namespace tricue
