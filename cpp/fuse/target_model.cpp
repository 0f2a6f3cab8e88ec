// SPDX-License-Identifier: MIT
#include "fuse/target_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/row_block.hpp"
#include "base/simd.hpp"
#include "fuse/detail/rectangle_pixels.hpp"
#include "fuse/target_distribution.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

constexpr double kMinSum = 1e-300;  // keeps a density of zeros from a division by 0

ValueRange range_of(const ExpectedPeak& peak, int bins) {
    return {peak.value - peak.half_range, peak.value + peak.half_range, bins};
}

void require_former(const FormerModel& before, std::size_t count, int bins) {
    require_shape(before.densities, static_cast<Index>(count), bins, "before");
    for (const std::size_t given : {before.lows.size(), before.peaks.size()})
        if (given != count)
            refuse("before", std::to_string(count) + " lows and peaks", std::to_string(given));
}

void require_arguments(const std::vector<CueMap>& maps, const std::vector<ExpectedPeak>& expected,
                       const std::optional<TargetBlocks>& blocks, const std::optional<FormerModel>& before,
                       const HistogramRules& rules) {
    if (maps.empty() || maps.size() > kMaxMaps) refuse("maps", "1 to 3", std::to_string(maps.size()));
    if (expected.size() != maps.size())
        refuse("expected", std::to_string(maps.size()) + ", as many as maps",
               std::to_string(expected.size()));
    for (const CueMap& map : maps)
        for (const PlaneView& plane : {map.values, map.weights})
            require_same_shape(plane, maps[0].values, "maps");
    if (rules.bins < 2) refuse("bins", "2 to 65536", std::to_string(rules.bins));
    for (const ExpectedPeak& peak : expected) {
        require_range(range_of(peak, rules.bins));
        if (!(peak.deviation > 0.0)) refuse("expected", "deviations above 0", peak.deviation);
    }
    if (!(rules.smoothing > 0.0)) refuse("smoothing", "a number above 0", rules.smoothing);
    for (const auto& [share, name] : {std::pair{rules.density_memory, "density_memory"},
                                      std::pair{rules.surround_weight, "surround_weight"}})
        if (!(share >= 0.0 && share < 1.0)) refuse(name, "a number in [0, 1)", share);
    if (blocks) {
        require_numbers(blocks->grid, blocks->states, "states");
        require_numbers(blocks->grid, blocks->trusted, "trusted");
    }
    if (before) require_former(*before, maps.size(), rules.bins);
}

/// (H, W) 1 at the target's pixels; rows are padded to whole blocks.
Labels target_mask(const std::optional<TargetBlocks>& blocks, int rows, int cols) {
    if (!blocks) return Labels::Ones(rows, whole_blocks(cols));
    const auto& [grid, states, trusted] = *blocks;
    const std::vector<Region> all = block_pixels(grid, rows, cols);
    std::vector<Region> mine;
    for (Index i = 0; i < states.size(); ++i)
        if (states[i] == 1 && trusted[i] > 0) mine.push_back(all[static_cast<std::size_t>(i)]);
    return mask_regions(mine, rows, whole_blocks(cols));
}

TRICUE_MULTIVERSION
void mark_near(const float* __restrict values, float disparity, float tolerance, int n,
               std::uint8_t* __restrict near) {
    for_overlapping_blocks<16>(
        n, [=](std::ptrdiff_t x) { near[x] = !(std::abs(values[x] - disparity) > tolerance); });
}

/// (H, W) 1 where flow counts: at the target's depth, or where no depth is known; padded as well.
Labels depth_mask(const std::optional<DepthLimit>& depth, const PlaneView& disparity) {
    const int padded = whole_blocks(disparity.cols);
    if (!depth) return Labels::Ones(disparity.rows, padded);
    Labels near(disparity.rows, padded);
    const auto middle = static_cast<float>(depth->disparity),
               tolerance = static_cast<float>(depth->tolerance);
    for (int y = 0; y < disparity.rows; ++y)
        mark_near(disparity.row(y), middle, tolerance, disparity.cols, near.row(y).data());
    return near;
}

/// The density mixed with the previous one, which is moved down by `shift` bins; of sum 1.
Vector blended(const Vector& density, const double* before, double shift, double memory) {
    const Index bins = density.size();
    Vector both(bins);
    for (Index i = 0; i < bins; ++i) {
        const double at = static_cast<double>(i) + shift;
        double moved = 0.0;
        if (at >= 0.0 && at <= static_cast<double>(bins - 1)) {
            const Index low = std::min(static_cast<Index>(at), bins - 2);
            moved = (before[low + 1] - before[low]) * (at - static_cast<double>(low)) + before[low];
        }
        both[i] = memory * moved + (1.0 - memory) * density[i];
    }
    return both / std::max(both.sum(), kMinSum);
}

/// A Gaussian of sum 1, cut off at ceil(3 deviation) bins.
Vector gaussian_of(double deviation) {
    const auto radius = static_cast<Index>(std::ceil(3.0 * deviation));
    Vector gaussian(2 * radius + 1);
    for (Index j = -radius; j <= radius; ++j) {
        const double step = static_cast<double>(j) / deviation;
        gaussian[radius + j] = std::exp(-0.5 * (step * step));
    }
    return gaussian / gaussian.sum();
}

/// Smooths a histogram; weight that is spread beyond the ends is lost. From tap to tap, so that the compiler vectorizes.
TRICUE_MULTIVERSION
void smooth_by(const double* __restrict gaussian, std::ptrdiff_t radius, const double* __restrict histogram,
               std::ptrdiff_t bins, double* __restrict smooth) {
    const std::ptrdiff_t reach = std::min(radius, bins - 1);
    for (std::ptrdiff_t j = -reach; j <= reach; ++j) {
        const double share = gaussian[radius - j];
        const std::ptrdiff_t begin = std::max(-j, std::ptrdiff_t{0}), end = std::min(bins - j, bins);
        for (std::ptrdiff_t i = begin; i < end; ++i) smooth[i] += histogram[i + j] * share;
    }
}

Vector smoothed(const Vector& histogram, const Vector& gaussian) {
    Vector smooth = Vector::Zero(histogram.size());
    smooth_by(gaussian.data(), gaussian.size() / 2, histogram.data(), histogram.size(), smooth.data());
    return smooth;
}

Vector alternative(const WindowHistograms& found, const Vector& gaussian, const HistogramRules& rules) {
    const double uniform = 1.0 / rules.bins;
    if (!(rules.surround_weight > 0.0 && found.total > 0.0)) return Vector::Constant(rules.bins, uniform);
    return rules.surround_weight * smoothed(found.surround, gaussian) / found.total +
           (1.0 - rules.surround_weight) * uniform;
}

}  // namespace

TargetModel target_model(const std::vector<CueMap>& maps, const std::vector<ExpectedPeak>& expected,
                         const Rectangle& window, const std::optional<TargetBlocks>& blocks,
                         const std::optional<DepthLimit>& depth, const std::optional<FormerModel>& before,
                         const HistogramRules& rules) {
    require_arguments(maps, expected, blocks, before, rules);
    const PlaneView& last = maps.back().values;
    const Region inside = rectangle_pixels(window, last.rows, last.cols, "window");
    const Labels target = target_mask(blocks, last.rows, last.cols);
    const Labels near = depth_mask(depth, last);
    const auto count = static_cast<Index>(maps.size());
    std::vector<ValueRange> ranges;
    for (const ExpectedPeak& peak : expected) ranges.push_back(range_of(peak, rules.bins));
    const std::vector<WindowHistograms> all = sum_histograms(maps, ranges, inside, target, near);
    Vector gaussian;
    TargetModel model{States(count, rules.bins), States(count, rules.bins), Vector(count)};
    for (Index i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double width = 2.0 * expected[k].half_range / rules.bins, middle = rules.bins / 2.0;
        const WindowHistograms& found = all[k];
        auto [density, peak] = target_distribution(found.target, rules.smoothing, rules.min_prominence,
                                                   middle, expected[k].deviation / width);
        if (i == 0)
            gaussian = gaussian_of(rules.smoothing);  // not before target_distribution has checked its size
        if (std::isnan(peak))
            peak = middle;
        else if (before && rules.density_memory > 0.0) {
            const double former = (before->peaks[k] - before->lows[k]) / width;
            density = blended(density, before->densities.row(i).data(), former - peak, rules.density_memory);
        }
        model.densities.row(i) = density;
        model.alternatives.row(i) = alternative(found, gaussian, rules);
        model.peaks[i] = ranges[k].low + peak * width;
    }
    return model;
}

}  // namespace tricue
