// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"

namespace tricue {

struct RankWindow {
    /// float32 (3, n): mid-ranks of the samples, as color_ranks has them; in C++ one row of 3 n
    Floats ranks;
    Vector correlations;  ///< float64 (M,): in [0, 1], with each of the models
};

/// The order of the pixels in one ellipse, and its correlation with each rank map: what a color tracker learns, and its score.
///
/// The correlation is Spearman's, of all 3 n ranks; negative ones become 0. As the mean of a map is 1/2, it is (Σab − N/4) /
/// √((Σa² − N/4) (Σb² − N/4)), N = 3 n. A window or a map that is nearly flat has no order: the correlation is 0.
///
/// @param image uint8 (H, W, 3) BGR, at least one pixel, 2 GB at most
/// @param ellipse float64 (4,): center x, y, semi-axes along x and y, pixels, finite
/// @param pattern float64 (n, 2): places (u, v) inside the ellipse, in semi-axes, as in sample_ellipses, n at least 1
/// @param models float32 (M, 3, n): rank maps in [0, 1]; in C++ M rows of 3 n
/// @param flat the sum of squared deviations, Σa² − N/4, up to which there is no order, at least 0
/// @throws std::invalid_argument on other shapes or values
/// Source: orders of corresponding pixels, Sabeti, Parvizi, Wu 2008, section III.B; Spearman 1904.
RankWindow rank_window(const ImageView& image, VectorRef ellipse, StatesRef pattern, FloatsRef models,
                       double flat);

}  // namespace tricue
