// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/rank_window.hpp"

namespace tricue {

/// The places at which an ellipse and its surround are sampled.
struct EllipsePattern {
    /// float64 (n, 2): places (u, v) inside the ellipse, in semi-axes, as in sample_ellipses
    StatesRef inside;
    StatesRef around;  ///< float64 (m, 2): places (u, v) around it
};

/// What a target looks like: rank maps and their shares, and a table over colors.
struct ColorAppearance {
    /// float32 (M, 3, n): rank maps in [0, 1], as rank_distance takes them, M at least 1; in C++ M rows of 3 n
    FloatsRef models;
    VectorRef shares;  ///< float64 (M,): weight of each map in the mean distance, finite
    bool nearest;      ///< whether to take the least distance; shares then only have to be valid
    FloatsRef table;   ///< float32 (B, B, B), B a power of two up to 64: P(target | color)
};

/// How much a distance and a contrast count.
struct LikelihoodFactors {
    double sharpness;        ///< nats, finite
    double contrast_weight;  ///< nats, finite
};

/// Measures as rank_likelihood, more than once in an image. The arguments of its constructor must outlive it.
class RankLikelihood {
public:
    /// @throws std::invalid_argument as rank_likelihood
    RankLikelihood(const ImageView& image, const EllipsePattern& pattern, const ColorAppearance& appearance,
                   const LikelihoodFactors& factors);
    ~RankLikelihood();

    Vector log_likelihood(StatesRef ellipses);

    /// The rank_window of the first of at most eight ellipses that were measured last.
    RankWindow first_window(double flat) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// The measurement of the color particle tracker in one pass: log p(y | x) = −sharpness d² + contrast_weight c, nats.
///
/// d is the mean, weighted by the maps' shares, of the distances (rank_distance) between the samples inside the ellipse and each
/// rank map; or the least of these distances. c is the mean of the table over the samples inside minus that over those around the
/// ellipse. The samples are those of sample_ellipses; one pass keeps them in the cache.
///
/// @param image uint8 (H, W, 3) BGR, at least one pixel, 2 GB at most
/// @param ellipses float64 (N, 4): center x, y, semi-axes along x (minor) and y (major), pixels, finite
/// @returns float64 (N,)
/// @throws std::invalid_argument as the kernels that it combines, on a pattern without places, or without maps
/// Source: orders of corresponding pixels, Sabeti, Parvizi, Wu 2008, section III.B; the contrast is ours.
Vector rank_likelihood(const ImageView& image, StatesRef ellipses, const EllipsePattern& pattern,
                       const ColorAppearance& appearance, const LikelihoodFactors& factors);

}  // namespace tricue
