// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Where an ellipse is read: n x 2 places inside and m x 2 around it, as in sample_ellipses.
struct Windows {
    StatesRef inside;
    StatesRef around;
};

/// What a target looks like: M x 3n rank maps, as in rank_distance, and the table of P(target | color), as in color_lookup.
struct ColorLook {
    FloatsRef maps;
    FloatsRef table;
};

struct RankContrast {
    States distances;  ///< N x M: rank_distance of the samples inside
    Vector
        contrast;  ///< N: mean of the table over the samples inside minus that over those around, summed in float64
};

/// The default measurement of the color tracker in one pass, so that an ellipse's samples never leave the nearest cache:
/// sample_ellipses inside and around, rank_distance, and the color contrast of target and surround.
///
/// @param image    uint8 BGR, at least one pixel
/// @param ellipses N x 4: centre x, y, semi-axes along x (minor) and along y (major), pixels, finite
/// @throws std::invalid_argument as the kernels that it joins, and on a pattern without places
/// Source: orders of corresponding pixels, Sabeti, Parvizi, Wu 2008, section III.B; the contrast is ours.
RankContrast rank_contrast(const ImageView& image, StatesRef ellipses, const Windows& windows,
                           const ColorLook& look);

}  // namespace tricue
