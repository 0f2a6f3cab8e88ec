// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Looks up the color of each pixel of an image in a table, as color_lookup does for samples: P(target | color).
///
/// @param image uint8 (H, W, 3) BGR
/// @param table float32 (B, B, B), B a power of two up to 64; in C++ B² rows (blue, green) of B reds
/// @returns float32 (H, W)
/// @throws std::invalid_argument on a table of another size
/// Source: the normalized look-up table of Vezhnevets, Sazonov, Andreeva 2003, section 3.1.
Floats color_posterior(const ImageView& image, FloatsRef table);

}  // namespace tricue
