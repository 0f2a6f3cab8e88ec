// SPDX-License-Identifier: MIT
#include "cues/depth/depth_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "check.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

constexpr std::size_t kLanes = 4;  // sums of their own, so that an addition needn't wait for the one before

/// Columns and rows of a rectangle's places; those outside the image have row -1.
TRICUE_MULTIVERSION
void place(const double* __restrict u, const double* __restrict v, std::ptrdiff_t n, const double* rectangle,
           int cols, int rows, std::int32_t* __restrict column, std::int32_t* __restrict row) {
    const double center_x = rectangle[0], center_y = rectangle[1];
    const double half_width = 0.5 * rectangle[2], half_height = 0.5 * rectangle[3];
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const double x = center_x + half_width * u[k], y = center_y + half_height * v[k];
        const bool inside = (x >= 0.0) & (x < cols) & (y >= 0.0) & (y < rows);
        column[k] = static_cast<std::int32_t>(inside ? x : 0.0);
        row[k] = static_cast<std::int32_t>(inside ? y : -1.0);
    }
}

/// Levels of depths relative to z, `levels` of what doesn't count. Returns how many are below `limit`.
TRICUE_MULTIVERSION
int find_levels(const float* __restrict depth, std::ptrdiff_t n, double z, double reach, double levels,
                double limit, std::int32_t* __restrict level) {
    const double scale = levels / (2.0 * reach);
    int nearer = 0;
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const bool measured = (depth[k] > 0.0f) & (depth[k] <= std::numeric_limits<float>::max());
        const double metres = static_cast<double>(depth[k]);
        const double at = ((metres - z) + reach) * scale;
        const bool counts = measured & (at >= 0.0) & (at < levels);
        level[k] = static_cast<std::int32_t>(counts ? at : levels);
        nearer += measured & (metres < limit);
    }
    return nearer;
}

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

/// Measures one rectangle after the other.
class Meter {
public:
    Meter(const DepthView& depth, const DepthModel& model, StatesRef pattern, double nearer)
        : depth_(depth),
          model_(model),
          nearer_(nearer),
          u_(pattern.col(0)),
          v_(pattern.col(1)),
          column_(static_cast<std::size_t>(pattern.rows())),
          row_(column_.size()),
          level_(column_.size()),
          seen_(column_.size()),
          counts_(static_cast<std::size_t>(model.histogram.size()) + 1) {}

    void measure(const double* rectangle, double* result) {
        const std::ptrdiff_t n = u_.size();
        place(u_.data(), v_.data(), n, rectangle, depth_.cols, depth_.rows, column_.data(), row_.data());
        for (std::size_t k = 0; k < seen_.size(); ++k)
            seen_[k] = row_[k] < 0 ? 0.0f : depth_.row(row_[k])[column_[k]];
        const double z = rectangle[4];
        const auto levels = static_cast<double>(model_.histogram.size());
        const int before = find_levels(seen_.data(), n, z, model_.reach, levels, z - nearer_, level_.data());
        std::fill(counts_.begin(), counts_.end(), 0);
        for (const std::int32_t level : level_) ++counts_[static_cast<std::size_t>(level)];
        const auto places = static_cast<double>(n), counted = places - counts_.back();
        result[0] = distance(counted);
        result[1] = counted / places;
        result[2] = before / places;
    }

private:
    double distance(double counted) const {
        if (counted == 0.0) return 1.0;
        const double square =
            squared_distance(counts_.data(), counted, model_.histogram.data(), counts_.size() - 1);
        return std::min(std::sqrt(0.5 * square), 1.0);
    }

    DepthView depth_;
    DepthModel model_;
    double nearer_;
    Vector u_, v_;
    std::vector<std::int32_t> column_, row_, level_;
    std::vector<float> seen_;
    std::vector<std::int32_t> counts_;  ///< of every level, and of what doesn't count
};

void require_model(const DepthModel& model) {
    constexpr double kRounding = 1e-6;  // of a histogram that was float32
    if (model.histogram.size() < 1) refuse("model", "at least one level", "none");
    double sum = 0.0;
    for (const double share : model.histogram) {
        if (!(share >= 0.0 && std::isfinite(share))) refuse("model", "finite numbers, none negative", share);
        sum += share;
    }
    if (sum != 0.0 && !(std::abs(sum - 1.0) <= kRounding)) refuse("model", "a sum of 1, or of 0", sum);
    if (!(model.reach > 0.0 && std::isfinite(model.reach)))
        refuse("reach", "a finite number above 0", model.reach);
}

}  // namespace

States depth_distance(const DepthView& depth, StatesRef rectangles, const DepthModel& model,
                      StatesRef pattern, double nearer) {
    require_shape(rectangles, rectangles.rows(), 5, "rectangles");
    require_shape(pattern, pattern.rows(), 2, "pattern");
    if (pattern.rows() < 1) refuse("pattern", "at least one place", "none");
    require_finite(rectangles, "rectangles");
    require_model(model);
    require_finite(pattern, "pattern");
    if (!(nearer >= 0.0 && std::isfinite(nearer))) refuse("nearer", "a finite number, not negative", nearer);

    Meter meter(depth, model, pattern, nearer);
    States measured(rectangles.rows(), 3);
    for (Eigen::Index i = 0; i < rectangles.rows(); ++i)
        meter.measure(rectangles.row(i).data(), measured.row(i).data());
    return measured;
}

}  // namespace tricue
