// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Connected regions of skin (8 neighbors) in a whole image: where to look for a face that was lost.
///
/// @param image uint8 (H, W, 3) BGR
/// @param reference uint8 (3,): the reference color c0, B, G, R
/// @param threshold a pixel is skin where Δ > threshold (skin_boundary), in [-1, 1]
/// @param min_area smallest area, pixels, at least 1
/// @returns float64 (M, 7): x, y, width, height of the bounding box, area, centroid cx, cy, pixels; a pixel stands for its center.
///     Largest area first, then by y and x of the box, then by the first pixel in reading order
/// @throws std::invalid_argument on a threshold outside [-1, 1] or a min_area below 1
/// Source: Sabeti, Parvizi, Wu 2008, equations (5)-(10); labeling after Rosenfeld, Pfaltz 1966.
States skin_blobs(const ImageView& image, const Bgr& reference, double threshold, int min_area);

}  // namespace tricue
