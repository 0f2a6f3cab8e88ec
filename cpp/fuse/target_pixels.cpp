// SPDX-License-Identifier: MIT
#include "fuse/target_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"
#include "fuse/detail/rectangle_pixels.hpp"
#include "fuse/detail/value_bins.hpp"

namespace tricue {
namespace {

using Table = std::vector<float>;

/// Rows whose ratios are looked up at once, because a small region's rows are too short for a loop each.
constexpr int kBandPixels = 4096;

constexpr double kSumTolerance = 1e-6;  // of the densities' sums
constexpr double kMaxRatio = 1e12;      // the product of three fits a float

void require_density(VectorRef density) {
    double sum = 0.0;
    for (const double share : density) {
        if (!(share >= 0.0 && std::isfinite(share)))
            refuse("densities", "finite numbers, none negative", share);
        sum += share;
    }
    if (sum != 0.0 && !(std::abs(sum - 1.0) <= kSumTolerance))
        refuse("densities", "a sum of 1, or of 0", sum);
}

void require_alternative(VectorRef alternative, Eigen::Index bins) {
    require_size(alternative, bins, "alternatives");
    double sum = 0.0;
    for (const double share : alternative) {
        if (!(share > 0.0 && std::isfinite(share))) refuse("alternatives", "finite numbers above 0", share);
        sum += share;
    }
    if (!(sum <= 1.0 + kSumTolerance)) refuse("alternatives", "a sum of at most 1", sum);
}

ValueRange range_of(const Cue& cue) {
    return {cue.low, cue.high, static_cast<int>(cue.density.size())};
}

void require_arguments(const std::vector<Cue>& cues, double threshold) {
    if (cues.empty() || cues.size() > 3) refuse("planes", "1 to 3", std::to_string(cues.size()));
    for (const Cue& cue : cues) require_same_shape(cue.readings, cues[0].readings, "planes");
    for (const Cue& cue : cues) {
        require_range(range_of(cue));
        require_density(cue.density);
        if (cue.alternative) require_alternative(*cue.alternative, cue.density.size());
    }
    if (!(threshold > 0.0 && threshold <= 1.0)) refuse("threshold", "a number in (0, 1]", threshold);
}

/// Likelihood ratios of each bin, target to alternative; 0 without a measurement.
Table likelihood_ratios(const Cue& cue) {
    const Eigen::Index count = cue.density.size();
    const auto bins = static_cast<double>(count);
    Table table;
    table.reserve(static_cast<std::size_t>(count) + 1);
    for (Eigen::Index i = 0; i < count; ++i) {
        const double share = cue.density[i];
        const double ratio =
            cue.alternative ? std::min(share / (*cue.alternative)[i], kMaxRatio) : share * bins;
        table.push_back(static_cast<float>(ratio));
    }
    table.push_back(0.0f);
    return table;
}

/// The prior of the columns (or rows) [first, last).
std::vector<float> linear_prior(double inner, double inner_end, double outer, double outer_end, int first,
                                int last) {
    std::vector<float> prior;
    prior.reserve(static_cast<std::size_t>(last - first));
    for (int i = first; i < last; ++i) {
        const double center = i + 0.5;
        double least = 1.0;
        if (inner > outer) least = std::min(least, (center - outer) / (inner - outer));
        if (inner_end < outer_end) least = std::min(least, (outer_end - center) / (outer_end - inner_end));
        prior.push_back(static_cast<float>(std::max(least, 0.0)));
    }
    return prior;
}

TRICUE_MULTIVERSION
void multiply_ratios(const std::int32_t* __restrict bin, int n, const float* __restrict table,
                     float* __restrict ratio) {
    for (int x = 0; x < n; ++x) ratio[x] *= table[bin[x]];
}

TRICUE_MULTIVERSION
void apply_bayes(const float* __restrict ratio, const float* __restrict columns, float row, int n,
                 float threshold, float* __restrict posterior, std::uint8_t* __restrict mask) {
    for_overlapping_blocks<16>(n, [=](std::ptrdiff_t x) {
        const float product = std::min(columns[x], row) * ratio[x];  // P(obj) L / A
        const float share = product / (product + 1.0f);
        posterior[x] = share;
        mask[x] = share >= threshold;
    });
}

}  // namespace

TargetPixels target_pixels(const std::vector<Cue>& cues, const TargetPlace& place, double threshold) {
    require_arguments(cues, threshold);
    const auto& [window, candidate] = place;
    require_corners(window, "window");
    const PlaneView& first = cues[0].readings;
    const Region visible = rectangle_pixels(candidate, first.rows, first.cols, "candidate");
    const auto columns =
        linear_prior(window.x0, window.x1, candidate.x0, candidate.x1, visible.x0, visible.x1);
    const auto rows = linear_prior(window.y0, window.y1, candidate.y0, candidate.y1, visible.y0, visible.y1);
    std::vector<Table> tables;
    std::vector<FloatRange> ranges;
    for (const Cue& cue : cues) {
        tables.push_back(likelihood_ratios(cue));
        ranges.emplace_back(range_of(cue));
    }

    TargetPixels target{Labels::Zero(first.rows, first.cols), Floats::Zero(first.rows, first.cols)};
    const int band = std::max(kBandPixels / std::max(first.cols, 1), 1);
    std::vector<std::int32_t> bin(static_cast<std::size_t>(band) * static_cast<std::size_t>(first.cols));
    std::vector<float> ratio(bin.size());
    for (int y0 = visible.y0; y0 < visible.y1; y0 += band) {
        const int y1 = std::min(y0 + band, visible.y1);
        std::fill(ratio.begin(), ratio.end(), 1.0f);
        for (std::size_t k = 0; k < cues.size(); ++k) {
            const PlaneView& plane = cues[k].readings;
            const int together = plane.stride == plane.cols ? y1 - y0 : 1;  // contiguous rows
            for (int y = y0; y < y1; y += together)
                find_value_bins(plane.row(y), together * plane.cols, ranges[k],
                                bin.data() + std::ptrdiff_t{y - y0} * plane.cols);
            multiply_ratios(bin.data(), (y1 - y0) * plane.cols, tables[k].data(), ratio.data());
        }
        for (int y = y0; y < y1; ++y)
            apply_bayes(ratio.data() + std::ptrdiff_t{y - y0} * first.cols + visible.x0, columns.data(),
                        rows[static_cast<std::size_t>(y - visible.y0)], visible.x1 - visible.x0,
                        round_up_to_float(threshold), target.posterior.row(y).data() + visible.x0,
                        target.mask.row(y).data() + visible.x0);
    }
    return target;
}

}  // namespace tricue
