// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/rank_likelihood.hpp"

namespace tricue {

/// The best window of a search, and what the search began with.
struct FoundEllipse {
    Vector ellipse;              ///< float64 (4,): center x, y, semi-axes along x and y, pixels
    double log_likelihood;       ///< of that ellipse, nats
    double log_likelihood_here;  ///< of the ellipse that was passed
};

/// Searches around an ellipse for the most likely window, by rank_likelihood.
///
/// The windows are the ellipse itself and, for each (u, v, a, b) of offsets, the ellipse that is moved by u and v of its semi-axes
/// along x and y, and whose semi-axes are a and b times as long. Of equally likely ones the first wins.
///
/// @param image uint8 (H, W, 3) BGR, at least one pixel, 2 GB at most
/// @param ellipse float64 (4,): center x, y, semi-axes along x (minor) and y (major), pixels, finite
/// @param offsets float64 (K, 4): finite
/// @throws std::invalid_argument as rank_likelihood, and on windows that aren't finite
/// Source: ours
FoundEllipse rank_search(const ImageView& image, VectorRef ellipse, StatesRef offsets,
                         const EllipsePattern& pattern, const ColorAppearance& appearance,
                         const LikelihoodFactors& factors);

}  // namespace tricue
