// SPDX-License-Identifier: MIT
#include "fuse/filter_rectangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/check.hpp"
#include "cues/depth/depth_distance.hpp"
#include "fuse/resample.hpp"
#include "fuse/reweight.hpp"
#include "fuse/summarize.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

constexpr Index kNumbers = 5;  // numbers in a state
constexpr double kMinLikelihood = 1e-12;

/// Centers and sizes in pixels, and the depth to which a model's levels are relative: the rectangle's own, unless all share one.
States project(VectorRef camera, StatesRef states, double middle) {
    States rectangles(states.rows(), kNumbers);
    for (Index i = 0; i < states.rows(); ++i) {
        const auto each = states.row(i);
        const double per_x = camera[0] / each[2], per_y = camera[1] / each[2];
        rectangles.row(i) << each[0] * per_x + (camera[2] + 0.5), each[1] * per_y + (camera[3] + 0.5),
            each[3] * per_x, each[4] * per_y, middle > 0.0 ? middle : each[2];
    }
    return rectangles;
}

/// Middles of rows x columns equal parts of [-1, 1] x [-1, 1].
States grid_pattern(const RectanglePattern& places) {
    States pattern(Index{places.rows} * places.columns, 2);
    const auto middle = [](int i, int n) { return (2 * i + 1) / static_cast<double>(n) - 1.0; };
    for (int row = 0; row < places.rows; ++row)
        for (int column = 0; column < places.columns; ++column)
            pattern.row(Index{row} * places.columns + column) << middle(column, places.columns),
                middle(row, places.rows);
    return pattern;
}

constexpr double kNoModel = 0.0;  ///< a placeholder model of one level, if the comparison isn't used

/// The measurements in and around rectangles.
class Observer {
public:
    Observer(const DepthView& depth, VectorRef camera, const DepthLikelihood& by)
        : depth_(depth),
          camera_(camera),
          by_(by),
          contrast_(depth, camera, contrast_model(), by.places, by.occluder_margin) {}

    /// (N, 4) as by depth_contrast, but with the distance from the model in the model's own levels.
    States measure(StatesRef states, bool with_nearer) {
        States measured = contrast_.measure(states, with_nearer);
        if (!is_one_range())
            measured.col(0) = depth_distance(depth_, project(camera_, states, by_.middle), model(),
                                             grid_pattern(by_.places), by_.occluder_margin)
                                  .col(0);
        return measured;
    }

    /// The measurements of a state that was just measured.
    Vector histogram(const double* state) const {
        if (is_one_range()) return contrast_.shares();
        const double z = by_.middle > 0.0 ? by_.middle : state[2];
        return depth_shares(depth_, camera_, state, by_.places, z, by_.span, by_.model.size());
    }

    Vector log_likelihood(StatesRef states, const RectanglePrior& known) {
        const States measured = measure(states, false);
        const Vector prior = rectangle_prior(states, known.mean_size, known.measured);
        Vector logs(states.rows());
        for (Index i = 0; i < logs.size(); ++i) {
            const double distance = measured(i, 0), inside = measured(i, 1), around = measured(i, 3);
            const double likeness = by_.linear ? std::log(std::max(1.0 - distance, kMinLikelihood))
                                               : -by_.sharpness * distance * distance;
            logs[i] = (likeness + by_.contrast * (inside - around)) + prior[i];
        }
        return logs;
    }

private:
    /// Whether the model's levels cover exactly the depths whose share is measured.
    bool is_one_range() const { return by_.middle == 0.0 && by_.span == by_.reach; }

    ReferenceHistogram model() const { return {by_.model, by_.span}; }

    ReferenceHistogram contrast_model() const {
        if (is_one_range()) return model();
        return {Eigen::Map<const Vector>(&kNoModel, 1), by_.reach};
    }

    const DepthView& depth_;
    VectorRef camera_;
    const DepthLikelihood& by_;
    RectangleContrast contrast_;
};

Eigen::Map<const States> sampling(const StackView<double>& noise, int plane) {
    return {noise.row(plane, 0), noise.rows, noise.cols};
}

States draw_around(VectorRef mean, const Refinement& refinement, double nearest, StatesRef noise) {
    constexpr double kAny = -std::numeric_limits<double>::infinity();
    const double lower[kNumbers] = {kAny, kAny, nearest, refinement.min_size, refinement.min_size};
    States close(noise.rows(), noise.cols());
    for (Index i = 0; i < close.rows(); ++i)
        for (Index d = 0; d < kNumbers; ++d)
            close(i, d) = std::max(mean[d] + refinement.scale[d] * noise(i, d), lower[d]);
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
    if (!(refinement.scale >= 0.0).all()) refuse("scale", "no negative number", refinement.scale.minCoeff());
    require_positive(refinement.min_size, "min_size");
    require_not_negative(likelihood.middle, "middle");
    if (!std::isfinite(likelihood.sharpness)) refuse("sharpness", "a finite number", likelihood.sharpness);
    if (!std::isfinite(likelihood.contrast)) refuse("contrast", "a finite number", likelihood.contrast);
}

}  // namespace

FilteredRectangles filter_rectangles(const DepthView& depth, VectorRef camera,
                                     const WeightedRectangles& before, const StackView<double>& noise,
                                     const Dynamics& dynamics, const Bounds& bounds,
                                     const Detection& detection, const Refinement& refinement,
                                     const DepthLikelihood& likelihood, const RectanglePrior& prior) {
    require_arguments(before, noise, refinement, likelihood);
    Observer observer(depth, camera, likelihood);
    const Indices chosen = resample(before.weights, before.offset);
    States previous(before.particles.rows(), kNumbers);
    for (Index i = 0; i < chosen.size(); ++i) previous.row(i) = before.particles.row(chosen[i]);
    FilteredRectangles after;
    const auto weigh = [&](const States& from, const Dynamics& moves, const Detection& seen) {
        const Vector logs = observer.log_likelihood(after.particles, prior);
        after.weights = reweight(logs, after.particles, from, moves, seen).weights;
    };
    after.particles = propose(previous, dynamics, sampling(noise, 0), detection, bounds);
    weigh(previous, dynamics, detection);
    if (noise.planes > 1) {
        const Vector middle = weighted_mean(after.particles, after.weights);
        after.particles = draw_around(middle, refinement, bounds.lower[2], sampling(noise, 1));
        const Vector still = Vector::Zero(kNumbers);
        weigh(after.particles, {still, refinement.scale}, {detection.mean, detection.root, 0.0});
    }
    Summary summary = summarize(after.particles, after.weights);
    after.mean = std::move(summary.mean);
    after.covariance = std::move(summary.covariance);
    const Eigen::Map<const States> mean(after.mean.data(), 1, kNumbers);
    after.observed = observer.measure(mean, true).row(0);
    after.histogram = observer.histogram(after.mean.data());
    return after;
}

}  // namespace tricue
