// SPDX-License-Identifier: MIT
#include "cues/depth/detail/relative_histogram.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr std::size_t kLanes = 4;  // tables and sums side by side, so that none waits for the previous one

/// Samples and counters are padded to whole blocks, because a loop's remainder would take as long as the loop.
constexpr std::size_t kBlock = 16;

constexpr std::size_t whole_blocks(std::size_t n) {
    return (n + kBlock - 1) / kBlock * kBlock;
}

/// The levels of depths from `near` on, `scale` for each meter.
struct LevelScale {
    float near, scale;

    LevelScale(double z, double reach, int levels)
        : near(static_cast<float>(z - reach)), scale(static_cast<float>(levels / (2.0 * reach))) {}
};

/// Counts the level of each depth, or `levels` if it doesn't count. Neighbors count in different tables of `size` counters.
TRICUE_MULTIVERSION
void find_levels(const float* __restrict depth, std::size_t n, const LevelScale& by, int levels,
                 std::int32_t size, std::int32_t* __restrict level) {
    const float near = by.near, scale = by.scale, end = static_cast<float>(levels);
    std::int32_t table[kBlock];
    for (std::size_t i = 0; i < kBlock; ++i) table[i] = static_cast<std::int32_t>(i % kLanes) * size;
    for (std::size_t first = 0; first < n; first += kBlock, depth += kBlock, level += kBlock)
        for (std::size_t i = 0; i < kBlock; ++i) {
            const float at = (depth[i] - near) * scale;
            const bool counts = has_depth(depth[i]) & (at >= 0.0f) & (at < end);
            level[i] = static_cast<std::int32_t>(counts ? at : end) + table[i];
        }
}

/// Adds the tables to the first one.
TRICUE_MULTIVERSION
void add_tables(std::int32_t* __restrict counts, std::size_t size) {
    for (std::size_t first = 0; first < size; first += kBlock, counts += kBlock)
        for (std::size_t i = 0; i < kBlock; ++i)
            counts[i] += (counts[size + i] + counts[2 * size + i]) + counts[3 * size + i];
}

/// sum (c - m total)².
TRICUE_MULTIVERSION
double squared_distance(const std::int32_t* __restrict counts, double total, const double* __restrict model,
                        std::size_t levels) {
    constexpr std::size_t kSums = 8;
    double sums[kSums] = {};
    std::size_t level = 0;
    for (; level + kSums <= levels; level += kSums)
        for (std::size_t i = 0; i < kSums; ++i) {
            const double difference = counts[level + i] - total * model[level + i];
            sums[i] += difference * difference;
        }
    for (; level < levels; ++level) {
        const double difference = counts[level] - total * model[level];
        sums[0] += difference * difference;
    }
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

}  // namespace

std::size_t RelativeHistogram::padded(std::size_t samples) {
    return whole_blocks(samples);
}

RelativeHistogram::RelativeHistogram(Eigen::Index levels, double reach, std::size_t samples)
    : reach_(reach),
      levels_(static_cast<int>(levels)),
      samples_(samples),
      level_(whole_blocks(samples)),
      table_(whole_blocks(static_cast<std::size_t>(levels) + 1)),
      counts_(kLanes * table_) {
    require_positive(reach, "reach");
}

void RelativeHistogram::read(const float* depths, double z) {
    find_levels(depths, level_.size(), {z, reach_, levels_}, levels_, static_cast<std::int32_t>(table_),
                level_.data());
}

void RelativeHistogram::count() {
    std::fill(counts_.begin(), counts_.end(), 0);
    std::int32_t* counts = counts_.data();
    const std::int32_t* level = level_.data();
    for (std::size_t k = 0; k < level_.size(); k += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane) ++counts[level[k + lane]];
}

void RelativeHistogram::count_beside(RelativeHistogram& other) {
    std::fill(counts_.begin(), counts_.end(), 0);
    std::fill(other.counts_.begin(), other.counts_.end(), 0);
    std::int32_t *counts = counts_.data(), *others = other.counts_.data();
    const std::int32_t *level = level_.data(), *other_level = other.level_.data();
    for (std::size_t k = 0; k < level_.size(); k += kLanes)
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            ++counts[level[k + lane]];
            ++others[other_level[k + lane]];
        }
}

void RelativeHistogram::finish() {
    add_tables(counts_.data(), table_);
}

void RelativeHistogram::count(const float* depths, double z) {
    read(depths, z);
    count();
    finish();
}

Vector RelativeHistogram::shares() const {
    if (total() == 0.0) return Vector::Zero(levels_);
    return Eigen::Map<const Eigen::Array<std::int32_t, Eigen::Dynamic, 1>>(counts_.data(), levels_)
               .cast<double>() /
           total();
}

double RelativeHistogram::distance(VectorRef model) const {
    const double square = squared_differences(model), counted = total();
    double distance;
    find_distances(&square, &counted, 1, &distance);
    return distance;
}

double RelativeHistogram::squared_differences(VectorRef model) const {
    return squared_distance(counts_.data(), total(), model.data(), static_cast<std::size_t>(model.size()));
}

TRICUE_MULTIVERSION
void find_distances(const double* __restrict squares, const double* __restrict totals, std::size_t n,
                    double* __restrict distances) {
    for (std::size_t i = 0; i < n; ++i) {
        const double distance = std::sqrt(0.5 * squares[i]) / totals[i];
        distances[i] = (totals[i] > 0.0) & (distance < 1.0) ? distance : 1.0;
    }
}

namespace {

TRICUE_MULTIVERSION
int count_below_float(const float* __restrict depth, std::size_t n, float limit) {
    int below = 0;
    for (std::size_t k = 0; k < n; ++k) below += has_depth(depth[k]) & (depth[k] < limit);
    return below;
}

}  // namespace

int count_below(const float* depth, std::size_t n, double limit) {
    return count_below_float(depth, n, round_up_to_float(limit));
}

TRICUE_MULTIVERSION
int count_within(const float* __restrict depth, std::size_t n, double z, double reach) {
    const LevelScale by(z, reach, 1);
    const float near = by.near, scale = by.scale;
    int within = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const float at = (depth[k] - near) * scale;
        within += has_depth(depth[k]) & (at >= 0.0f) & (at < 1.0f);
    }
    return within;
}

void require_model(VectorRef model) {
    constexpr double kRounding = 1e-6;  // of a histogram that was stored as float32
    if (model.size() < 1) refuse("model", "at least one level", "none");
    double sum = 0.0;
    for (const double share : model) {
        if (!(share >= 0.0 && std::isfinite(share))) refuse("model", "finite numbers, none negative", share);
        sum += share;
    }
    if (sum != 0.0 && !(std::abs(sum - 1.0) <= kRounding)) refuse("model", "a sum of 1, or of 0", sum);
}

void require_occluder_margin(double occluder_margin) {
    require_not_negative(occluder_margin, "occluder_margin");
}

}  // namespace tricue
