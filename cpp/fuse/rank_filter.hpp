// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/rank_likelihood.hpp"
#include "fuse/propose.hpp"

namespace tricue {

/// Particles as they were after the last frame.
struct WeightedEllipses {
    StatesRef particles;  ///< float64 (N, 4): ellipses, as in rank_likelihood, N at least 1
    VectorRef weights;    ///< float64 (N,), finite, none negative, not all 0; need not sum to 1
    /// offset of resample's comb, in [0, 1); None: particles aren't resampled, and their weights count
    std::optional<double> offset;
};

/// The noise that moves particles.
struct EllipseNoise {
    StatesRef white;  ///< float64 (N, 4): independent standard normal numbers
    /// of both semi-axes' noise, made by mixing the minor one's into the major one's, in [-1, 1]
    double correlation;
};

/// Particles after a frame, and their estimate of the target.
struct FilteredEllipses {
    States particles;       ///< float64 (N, 4)
    Vector weights;         ///< float64 (N,): of sum 1
    double effective;       ///< effective sample size, from 1 to N
    Vector ellipse;         ///< float64 (4,): expected value
    double log_likelihood;  ///< of that ellipse, nats
    Floats ranks;         ///< float32 (3, n): of that ellipse, as rank_window has them; in C++ one row of 3 n
    Vector correlations;  ///< float64 (M,): of that ellipse, as rank_window has them
};

/// One step of the color particle tracker's filter: particles are drawn, weighted by the image under them, and summarized.
///
/// It combines resample; propose; rank_likelihood, to which the logarithms of the weights are added where nothing was resampled,
/// a weight counting as at least 1e-300; reweight; summarize; and rank_likelihood and rank_window of the expected value. So
/// particles stay in the cache between these steps.
///
/// @param image uint8 (H, W, 3) BGR, at least one pixel, 2 GB at most
/// @param dynamics (drift, scale), four numbers each, as in propose
/// @param bounds (lower, upper), four numbers each, as in propose
/// @param detection (mean, root, share): two numbers, the three of the root's lower triangle by rows, and the share, as in propose
/// @param flat as in rank_window
/// @throws std::invalid_argument as the kernels that it combines, and on a correlation outside [-1, 1]
/// Source: Sabeti, Parvizi, Wu 2008, section III, equations (2), (30), (31).
FilteredEllipses rank_filter(const ImageView& image, const WeightedEllipses& last, const EllipseNoise& noise,
                             const Dynamics& dynamics, const Bounds& bounds, const Detection& detection,
                             const EllipsePattern& pattern, const ColorAppearance& appearance,
                             const LikelihoodFactors& factors, double flat);

}  // namespace tricue
