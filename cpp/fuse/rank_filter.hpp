// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/rank_likelihood.hpp"
#include "fuse/propose.hpp"

namespace tricue {

/// Particles as they were after the last frame.
struct WeightedEllipses {
    StatesRef particles;    ///< float64 (N, 4): ellipses, as in rank_likelihood, N at least 1
    VectorRef log_weights;  ///< float64 (N,): logarithms of their weights but for a constant, not above 0
};

/// Particles after a frame, and what they say of the target.
struct FilteredEllipses {
    States particles;       ///< float64 (N, 4)
    Vector weights;         ///< float64 (N,): of sum 1
    double effective;       ///< effective sample size, from 1 to N
    Vector ellipse;         ///< float64 (4,): expected value
    double log_likelihood;  ///< of that ellipse, nats
};

/// One step of the color particle tracker's filter: particles are drawn, weighed by what the image shows under them, and summed up.
///
/// It joins propose; rank_likelihood, to which the logarithms of the particles' weights are added; reweight; summarize; and
/// rank_likelihood of the expected value. So particles stay in the cache.
///
/// @param image uint8 (H, W, 3) BGR, at least one pixel
/// @param noise float64 (N, 4): independent standard normal numbers
/// @throws std::invalid_argument as the kernels that it joins, and on log_weights that are above 0 or not a number
/// Source: Sabeti, Parvizi, Wu 2008, section III, equations (2), (30), (31).
FilteredEllipses rank_filter(const ImageView& image, const WeightedEllipses& last, StatesRef noise,
                             const Dynamics& dynamics, const Bounds& bounds, const Detection& detection,
                             const Windows& windows, const ColorLook& look, const LookWeights& weights);

}  // namespace tricue
