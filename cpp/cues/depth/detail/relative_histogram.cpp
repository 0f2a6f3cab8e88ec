// SPDX-License-Identifier: MIT
#include "cues/depth/detail/relative_histogram.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr std::size_t kLanes = 4;  // tables and sums side by side, so that none waits for the one before

/// The level of each depth, `levels` where it doesn't count. Neighbors count in different tables, of `levels + 1` counters each.
TRICUE_MULTIVERSION
void find_levels(const float* __restrict depth, std::size_t n, double z, double reach, int levels,
                 std::int32_t* __restrict level) {
    const double scale = levels / (2.0 * reach), end = levels;
    for (std::size_t k = 0; k < n; ++k) {
        const double at = ((static_cast<double>(depth[k]) - z) + reach) * scale;
        const bool counts = has_depth(depth[k]) & (at >= 0.0) & (at < end);
        const auto table = static_cast<std::int32_t>(k % kLanes) * (levels + 1);
        level[k] = static_cast<std::int32_t>(counts ? at : end) + table;
    }
}

/// Adds the tables up in the first.
TRICUE_MULTIVERSION
void add_tables(std::int32_t* __restrict counts, std::size_t size) {
    for (std::size_t lane = 1; lane < kLanes; ++lane)
        for (std::size_t i = 0; i < size; ++i) counts[i] += counts[lane * size + i];
}

/// sum (c - m total)².
TRICUE_MULTIVERSION
double squared_distance(const std::int32_t* __restrict counts, double total, const double* __restrict model,
                        std::size_t levels) {
    double sums[kLanes] = {};
    std::size_t level = 0;
    for (; level + kLanes <= levels; level += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const double difference = counts[level + lane] - total * model[level + lane];
            sums[lane] += difference * difference;
        }
    for (; level < levels; ++level) {
        const double difference = counts[level] - total * model[level];
        sums[0] += difference * difference;
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

}  // namespace

RelativeHistogram::RelativeHistogram(Eigen::Index levels, double reach, std::size_t samples)
    : reach_(reach),
      levels_(static_cast<int>(levels)),
      level_(samples),
      counts_(kLanes * (static_cast<std::size_t>(levels) + 1)) {
    if (!(reach > 0.0 && std::isfinite(reach))) refuse("reach", "a finite number above 0", reach);
}

void RelativeHistogram::count(const float* depths, double z) {
    find_levels(depths, level_.size(), z, reach_, levels_, level_.data());
    std::fill(counts_.begin(), counts_.end(), 0);
    std::int32_t* counts = counts_.data();
    for (const std::int32_t level : level_) ++counts[level];
    add_tables(counts, static_cast<std::size_t>(levels_) + 1);
}

double RelativeHistogram::distance(VectorRef model) const {
    const double counted = total();
    if (counted == 0.0) return 1.0;
    const double square =
        squared_distance(counts_.data(), counted, model.data(), static_cast<std::size_t>(model.size()));
    return std::min(std::sqrt(0.5 * square) / counted, 1.0);
}

TRICUE_MULTIVERSION
int count_below(const float* __restrict depth, std::size_t n, double limit) {
    int below = 0;
    for (std::size_t k = 0; k < n; ++k)
        below += has_depth(depth[k]) & (static_cast<double>(depth[k]) < limit);
    return below;
}

TRICUE_MULTIVERSION
int count_within(const float* __restrict depth, std::size_t n, double z, double reach) {
    const double scale = 1.0 / (2.0 * reach);
    int within = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const double at = ((static_cast<double>(depth[k]) - z) + reach) * scale;
        within += has_depth(depth[k]) & (at >= 0.0) & (at < 1.0);
    }
    return within;
}

void require_model(VectorRef model) {
    constexpr double kRounding = 1e-6;  // of a histogram that was float32
    if (model.size() < 1) refuse("model", "at least one level", "none");
    double sum = 0.0;
    for (const double share : model) {
        if (!(share >= 0.0 && std::isfinite(share))) refuse("model", "finite numbers, none negative", share);
        sum += share;
    }
    if (sum != 0.0 && !(std::abs(sum - 1.0) <= kRounding)) refuse("model", "a sum of 1, or of 0", sum);
}

void require_nearer(double nearer) {
    if (!(nearer >= 0.0 && std::isfinite(nearer))) refuse("nearer", "a finite number, not negative", nearer);
}

}  // namespace tricue
