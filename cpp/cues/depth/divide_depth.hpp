// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_pixels.hpp"
#include "base/depth_view.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Division masks D_l in one image: the label l in 1 ... M where S(l) <= z < S(l + 1), 0 where there is none.
///
/// Depths are compared exactly. Where two dividers are equal their division is empty.
///
/// @param depth float32 (H, W), meters; pixels that are not measured get 0
/// @param mask uint8 (H, W): pixels where it is 0 get 0
/// @param dividers float64 (M + 1,): range dividers S(1) ... S(M + 1), meters, finite, ascending; M is 1 to 255
/// @returns uint8 (H, W): labels
/// @throws std::invalid_argument on a mask of another shape, or invalid dividers
/// Source: Sabeti, Parvizi, Wu 2008, equations (35), (36).
Labels divide_depth(const DepthView& depth, const ImageView& mask, VectorRef dividers);

}  // namespace tricue
