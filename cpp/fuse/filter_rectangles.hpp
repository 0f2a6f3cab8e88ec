// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/depth_view.hpp"
#include "base/stack_view.hpp"
#include "cues/depth/depth_contrast.hpp"
#include "fuse/detail/proposal.hpp"
#include "fuse/propose.hpp"
#include "fuse/rectangle_prior.hpp"

namespace tricue {

/// Weighted rectangles, and the offset with which they are resampled.
struct WeightedRectangles {
    StatesRef particles;
    VectorRef weights;
    double offset;
};

/// How the second sampling is drawn.
struct Refinement {
    VectorRef scale;
    double least;
};

/// How the depths in and around a rectangle give its likelihood.
struct DepthLikelihood {
    ReferenceHistogram model;
    double middle;
    RectanglePattern places;
    double reach, occluder_margin;
    bool linear;
    double sharpness, contrast;
};

/// N particles and their estimate.
struct FilteredRectangles {
    States particles;   ///< float64 (N, 5)
    Vector weights;     ///< float64 (N,) of sum 1
    Vector mean;        ///< float64 (5,): of the weighted particles
    States covariance;  ///< float64 (5, 5)
    Vector observed;    ///< float64 (4,): the result of depth_contrast for the mean
    Vector histogram;   ///< float64 (L,): of the depths in the mean, of sum 1; all 0 where nothing counts
};

/// One step of a particle filter on upright rectangles in meters (X, Y, Z, W, H) in front of a depth camera, by resample,
/// propose, depth_contrast, rectangle_prior, reweight and summarize.
///
/// A second sampling is drawn around the mean of the first: x = mean + scale * noise, Z at least its lower bound, W and H at least
/// `least`; its weights are the likelihoods. The log-likelihood is l(d) + contrast (inside - around) + rectangle_prior, where d,
/// inside and around are those of depth_contrast, and l(d) is -sharpness d², or log(max(1 - d, 1e-12)) where `linear`.
///
/// @param depth float32 (H, W), meters
/// @param camera float64 (4,): fx, fy, cx, cy, pixels
/// @param particles float64 (N, 5), finite, Z, W, H above 0
/// @param weights float64 (N,), as in resample
/// @param offset as in resample
/// @param noise float64 (S, N, 5), S 1 or 2 samplings: independent standard normal numbers, finite
/// @param dynamics (drift, scale), as in propose and reweight
/// @param bounds (lower, upper), as in propose
/// @param detection (mean, root, share), as in propose and reweight
/// @param refinement (scale, least): float64 (5,), none negative, and meters, above 0
/// @param model float64 (L,): histogram of depth, of sum 1, or all 0, none negative
/// @param levels (middle, span): the model's levels cover [middle - span, middle + span), meters; where the middle is 0, they are
///     relative to Z
/// @param grid (rows, columns), as in depth_contrast
/// @param ring (margin, along), as in depth_contrast
/// @param reach of the shares inside and around, meters, as in depth_contrast
/// @param occluder_margin meters, as in depth_contrast
/// @param likelihood (linear, sharpness, contrast): nats
/// @param mean_size (size, spread), as in rectangle_prior
/// @param measured (state, deviation, max_cost), as in rectangle_prior
/// @throws std::invalid_argument as those kernels
/// Source: Sabeti, Parvizi, Wu 2008, section IV; the second sampling and all of the likelihood but (37) are ours.
FilteredRectangles filter_rectangles(const DepthView& depth, VectorRef camera,
                                     const WeightedRectangles& before, const StackView<double>& noise,
                                     const Dynamics& dynamics, const Bounds& bounds,
                                     const Detection& detection, const Refinement& refinement,
                                     const DepthLikelihood& likelihood, const MeanSize& mean_size,
                                     const MeasuredState& measured);

}  // namespace tricue
