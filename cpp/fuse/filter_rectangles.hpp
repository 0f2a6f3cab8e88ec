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
    StatesRef particles;  ///< float64 (N, 5), finite, Z, W, H above 0
    VectorRef weights;    ///< float64 (N,), as in resample
    double offset;        ///< as in resample
};

/// How the second sampling is drawn.
struct Refinement {
    VectorRef scale;  ///< float64 (5,), none negative
    double min_size;  ///< of W and H, meters, above 0
};

/// How the depths in and around a rectangle give its likelihood.
struct DepthLikelihood {
    VectorRef model;  ///< float64 (L,): histogram of depth, of sum 1, or all 0, none negative
    /// the model's levels cover [middle - span, middle + span), meters; where the middle is 0, they are relative to Z
    double middle, span;
    RectanglePattern places;
    double reach;            ///< of the shares inside and around, meters, as in depth_contrast
    double occluder_margin;  ///< meters, as in depth_contrast
    bool linear;             ///< whether l(d) is the logarithm, not the square
    double sharpness;        ///< nats
    double contrast;         ///< nats
};

/// What is known of a rectangle before its depths are read.
struct RectanglePrior {
    MeanSize mean_size;
    MeasuredState measured;
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

/// One step of a particle filter on upright rectangles in meters (X, Y, Z, W, H), so D is 5, in front of a depth camera, by
/// resample, propose, depth_contrast, rectangle_prior, reweight and summarize.
///
/// A second sampling is drawn around the mean of the first: x = mean + scale * noise, Z at least its lower bound, W and H at least
/// `min_size`; its weights are the likelihoods. The log-likelihood is l(d) + contrast (inside - around) + rectangle_prior, where d,
/// inside and around are those of depth_contrast, and l(d) is -sharpness d², or log(max(1 - d, 1e-12)) where `linear`.
///
/// @param depth float32 (H, W), meters
/// @param camera float64 (4,): fx, fy, cx, cy, pixels
/// @param noise float64 (S, N, 5), S 1 or 2 samplings: independent standard normal numbers, finite
/// @throws std::invalid_argument as those kernels
/// Source: Sabeti, Parvizi, Wu 2008, section IV; the second sampling and all of the likelihood but (37) are ours.
FilteredRectangles filter_rectangles(const DepthView& depth, VectorRef camera,
                                     const WeightedRectangles& before, const StackView<double>& noise,
                                     const Dynamics& dynamics, const Bounds& bounds,
                                     const Detection& detection, const Refinement& refinement,
                                     const DepthLikelihood& likelihood, const RectanglePrior& prior);

}  // namespace tricue
