// SPDX-License-Identifier: MIT
#include "cues/depth/depth_distance.hpp"

#include <algorithm>
#include <cmath>

#include "check.hpp"
#include "depth_reader.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

constexpr std::size_t kLanes = 4;  // sums of their own, so that an addition needn't wait for the one before

/// sum (h - m)² of the shares h of the counts.
TRICUE_MULTIVERSION
double squared_distance(const std::int32_t* __restrict counts, double total, const double* __restrict model,
                        std::size_t levels) {
    double sums[kLanes] = {};
    std::size_t level = 0;
    for (; level + kLanes <= levels; level += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const double difference = counts[level + lane] / total - model[level + lane];
            sums[lane] += difference * difference;
        }
    for (; level < levels; ++level) {
        const double difference = counts[level] / total - model[level];
        sums[0] += difference * difference;
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

void require_model(const DepthModel& model) {
    constexpr double kRounding = 1e-6;  // of a histogram that was float32
    if (model.histogram.size() < 1) refuse("model", "at least one level", "none");
    double sum = 0.0;
    for (const double share : model.histogram) {
        if (!(share >= 0.0 && std::isfinite(share))) refuse("model", "finite numbers, none negative", share);
        sum += share;
    }
    if (sum != 0.0 && !(std::abs(sum - 1.0) <= kRounding)) refuse("model", "a sum of 1, or of 0", sum);
}

}  // namespace

States depth_distance(const DepthView& depth, StatesRef rectangles, const DepthModel& model,
                      StatesRef pattern, double nearer) {
    require_shape(rectangles, rectangles.rows(), 5, "rectangles");
    require_finite(rectangles, "rectangles");
    const Eigen::Index levels = model.histogram.size();
    DepthReader reader(depth, pattern, levels, model.reach, nearer);
    require_model(model);

    States measured(rectangles.rows(), 3);
    for (Eigen::Index i = 0; i < rectangles.rows(); ++i) {
        reader.read(rectangles.row(i).data());
        const double square = squared_distance(reader.counts(), reader.counted(), model.histogram.data(),
                                               static_cast<std::size_t>(levels));
        measured(i, 0) = reader.counted() > 0.0 ? std::min(std::sqrt(0.5 * square), 1.0) : 1.0;
        measured(i, 1) = reader.counted() / reader.places();
        measured(i, 2) = reader.before() / reader.places();
    }
    return measured;
}

}  // namespace tricue
