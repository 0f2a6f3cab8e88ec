// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// The connected regions of skin in a whole image (8 neighbours): where to look for a face that was lost.
///
/// @param image     BGR pixels
/// @param reference the reference color c0
/// @param threshold skin where Δ > threshold, in [-1, 1]
/// @param min_area  smallest area, pixels, at least 1
/// @returns         (M, 7), a row a blob: x, y, width, height of its box, area, centroid cx, cy, in pixels;
///                  a pixel stands for its centre. Largest area first, then by y and x of the box, then by
///                  the first pixel in reading order
/// @throws std::invalid_argument on a threshold outside [-1, 1] or a min_area below 1
/// Source: Sabeti, Parvizi, Wu 2008, equations (5)-(10); labelling after Rosenfeld, Pfaltz 1966.
States skin_blobs(const ImageView& image, const Bgr& reference, double threshold, int min_area);

}  // namespace tricue
