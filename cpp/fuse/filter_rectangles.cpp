// SPDX-License-Identifier: MIT
#include "fuse/filter_rectangles.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/check.hpp"
#include "cues/depth/depth_distance.hpp"
#include "fuse/resample.hpp"
#include "fuse/reweight.hpp"
#include "fuse/summarize.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

constexpr Index kNumbers = 5;  // of a state
constexpr double kMinLikelihood = 1e-12;

/// All that is the same for both samplings.
struct View {
    const DepthView& depth;
    VectorRef camera;
    const DepthLikelihood& likelihood;
    const UsualSize& usual;
    const MeasuredState& measured;
};

/// Centers and sizes in pixels, all at one depth.
States project(VectorRef camera, StatesRef states, double z) {
    States rectangles(states.rows(), kNumbers);
    for (Index i = 0; i < states.rows(); ++i) {
        const auto each = states.row(i);
        const double per_x = camera[0] / each[2], per_y = camera[1] / each[2];
        rectangles.row(i) << each[0] * per_x + (camera[2] + 0.5), each[1] * per_y + (camera[3] + 0.5),
            each[3] * per_x, each[4] * per_y, z;
    }
    return rectangles;
}

/// Middles of rows x columns equal parts of [-1, 1] x [-1, 1].
States grid_pattern(const Places& places) {
    States pattern(Index{places.rows} * places.columns, 2);
    const auto middle = [](int i, int n) { return (2 * i + 1) / static_cast<double>(n) - 1.0; };
    for (int row = 0; row < places.rows; ++row)
        for (int column = 0; column < places.columns; ++column)
            pattern.row(Index{row} * places.columns + column) << middle(column, places.columns),
                middle(row, places.rows);
    return pattern;
}

/// (N, 4) as by depth_contrast, the distance that of absolute depths where the model is of these.
States measure(const View& view, StatesRef states) {
    const DepthLikelihood& by = view.likelihood;
    if (by.middle == 0.0)
        return depth_contrast(view.depth, view.camera, states, by.model, by.places, by.nearer);
    const Vector nothing = Vector::Zero(1);
    States measured =
        depth_contrast(view.depth, view.camera, states, {nothing, by.reach}, by.places, by.nearer);
    measured.col(0) = depth_distance(view.depth, project(view.camera, states, by.middle), by.model,
                                     grid_pattern(by.places), by.nearer)
                          .col(0);
    return measured;
}

Vector log_likelihood(const View& view, StatesRef states) {
    const DepthLikelihood& by = view.likelihood;
    const States measured = measure(view, states);
    const Vector prior = rectangle_prior(states, view.usual, view.measured);
    Vector logs(states.rows());
    for (Index i = 0; i < logs.size(); ++i) {
        const double distance = measured(i, 0), inside = measured(i, 1), around = measured(i, 3);
        const double likeness = by.linear ? std::log(std::max(1.0 - distance, kMinLikelihood))
                                          : -by.sharpness * distance * distance;
        logs[i] = (likeness + by.contrast * (inside - around)) + prior[i];
    }
    return logs;
}

Eigen::Map<const States> sampling(const StackView<double>& noise, int plane) {
    return {noise.row(plane, 0), noise.rows, noise.cols};
}

States draw_around(VectorRef mean, const Refinement& refinement, StatesRef noise) {
    States close(noise.rows(), noise.cols());
    for (Index i = 0; i < close.rows(); ++i)
        for (Index d = 0; d < kNumbers; ++d) {
            const double x = mean[d] + refinement.scale[d] * noise(i, d);
            close(i, d) = d < 3 ? x : std::max(x, refinement.least);
        }
    return close;
}

void require_arguments(const WeightedRectangles& before, const StackView<double>& noise,
                       const Refinement& refinement, const DepthLikelihood& likelihood) {
    require_shape(before.particles, before.weights.size(), kNumbers, "particles");
    require_finite(before.particles, "particles");
    require_count(noise.planes, 1, 2, "noise");
    for (int plane = 0; plane < noise.planes; ++plane) {
        const StatesRef draws = sampling(noise, plane);
        require_shape(draws, before.particles.rows(), kNumbers, "noise");
        require_finite(draws, "noise");
    }
    require_size(refinement.scale, kNumbers, "scale");
    require_finite(refinement.scale, "scale");
    if (!(refinement.least > 0.0 && std::isfinite(refinement.least)))
        refuse("least", "a finite number above 0", refinement.least);
    if (!(likelihood.middle >= 0.0 && std::isfinite(likelihood.middle)))
        refuse("middle", "a finite number, not negative", likelihood.middle);
    if (!std::isfinite(likelihood.sharpness)) refuse("sharpness", "a finite number", likelihood.sharpness);
    if (!std::isfinite(likelihood.contrast)) refuse("contrast", "a finite number", likelihood.contrast);
}

}  // namespace

FilteredRectangles filter_rectangles(const DepthView& depth, VectorRef camera,
                                     const WeightedRectangles& before, const StackView<double>& noise,
                                     const Dynamics& dynamics, const Bounds& bounds,
                                     const Detection& detection, const Refinement& refinement,
                                     const DepthLikelihood& likelihood, const UsualSize& usual,
                                     const MeasuredState& measured) {
    require_arguments(before, noise, refinement, likelihood);
    const View view{depth, camera, likelihood, usual, measured};
    const Indices chosen = resample(before.weights, before.offset);
    States previous(before.particles.rows(), kNumbers);
    for (Index i = 0; i < chosen.size(); ++i) previous.row(i) = before.particles.row(chosen[i]);
    FilteredRectangles after;
    after.particles = propose(previous, dynamics, sampling(noise, 0), detection, bounds);
    after.weights =
        reweight(log_likelihood(view, after.particles), after.particles, previous, dynamics, detection)
            .weights;
    Summary summary = summarize(after.particles, after.weights);
    if (noise.planes > 1) {
        after.particles = draw_around(summary.mean, refinement, sampling(noise, 1));
        const Vector still = Vector::Zero(kNumbers);
        const Dynamics around{still, refinement.scale};
        const Detection nothing{detection.mean, detection.root, 0.0};
        after.weights =
            reweight(log_likelihood(view, after.particles), after.particles, after.particles, around, nothing)
                .weights;
        summary = summarize(after.particles, after.weights);
    }
    after.mean = std::move(summary.mean);
    after.covariance = std::move(summary.covariance);
    const Eigen::Map<const States> mean(after.mean.data(), 1, kNumbers);
    after.observed = measure(view, mean).row(0);
    const DepthModel& model = likelihood.model;
    after.histogram = depth_shares(depth, camera, after.mean.data(), likelihood.places,
                                   likelihood.middle == 0.0 ? after.mean[2] : likelihood.middle, model.reach,
                                   model.histogram.size());
    return after;
}

}  // namespace tricue
