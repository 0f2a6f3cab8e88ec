// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

/// Where an ellipse is read.
struct Windows {
    /// float64 (n, 2): places (u, v) inside the ellipse, in semi-axes, as in sample_ellipses
    StatesRef inside;
    StatesRef around;  ///< float64 (m, 2): places (u, v) around it
};

/// What a target looks like: rank maps, and a table over colors.
struct ColorLook {
    FloatsRef maps;
    FloatsRef table;
};

struct RankContrast {
    States distances;  ///< float64 (N, M): rank_distance of the samples inside
    Vector contrast;   ///< float64 (N,): mean of the table over the samples inside minus that around
};

/// The measurement of the color particle tracker in one pass: rank_distance of the samples inside each ellipse, and their color
/// contrast to those around it.
///
/// The samples are those of sample_ellipses; one pass keeps them in the cache.
///
/// @param image uint8 (H, W, 3) BGR, at least one pixel
/// @param ellipses float64 (N, 4): center x, y, semi-axes along x (minor) and y (major), pixels, finite
/// @param models float32 (M, 3, n): rank maps in [0, 1], as rank_distance takes them; in C++ M rows of 3 n
/// @param table float32 (B, B, B): P(target | color), as color_lookup takes it
/// @throws std::invalid_argument as the kernels that it joins, or on a pattern without places
/// Source: orders of corresponding pixels, Sabeti, Parvizi, Wu 2008, section III.B; the contrast is ours.
RankContrast rank_contrast(const ImageView& image, StatesRef ellipses, const Windows& windows,
                           const ColorLook& look);

}  // namespace tricue
