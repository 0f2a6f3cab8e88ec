// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// The mean color of every step-th pixel of an image, from step // 2 on: a measure of the light while the scene stays the same.
///
/// @param image uint8 (H, W, 3) BGR
/// @param step pixels from one sample to the next, 1 to 1024
/// @returns float64 (3,): blue, green and red; 0 where there is no sample
/// @throws std::invalid_argument on a step out of range
/// Source: ours, for von Kries' adaptation to the light.
Vector image_mean(const ImageView& image, int step);

}  // namespace tricue
