// SPDX-License-Identifier: MIT
#include "fuse/target_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/row_block.hpp"
#include "base/simd.hpp"
#include "fuse/detail/rectangle_pixels.hpp"
#include "fuse/detail/value_bins.hpp"

namespace tricue {
namespace {

using Table = std::vector<float>;

/// Rows whose ratios are looked up at once, because a small region's rows are too short for a loop each.
constexpr int kBandPixels = 4096;

constexpr std::size_t kMaxCues = 3;

/// Bins whose ratios fit four registers of AVX-512; the 0 of no measurement needs no room there.
constexpr std::size_t kTableRoom = 64;

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
    if (cues.empty() || cues.size() > kMaxCues) refuse("planes", "1 to 3", std::to_string(cues.size()));
    for (const Cue& cue : cues) require_same_shape(cue.values, cues[0].values, "planes");
    for (const Cue& cue : cues) {
        require_range(range_of(cue));
        require_density(cue.density);
        if (cue.alternative) require_alternative(*cue.alternative, cue.density.size());
    }
    if (!(threshold > 0.0 && threshold <= 1.0)) refuse("threshold", "a number in (0, 1]", threshold);
}

/// Likelihood ratios of each bin, target to alternative; 0 without a measurement, and up to kTableRoom.
Table likelihood_ratios(const Cue& cue) {
    const Eigen::Index count = cue.density.size();
    const auto bins = static_cast<double>(count);
    Table table;
    table.reserve(std::max(static_cast<std::size_t>(count) + 1, kTableRoom));
    for (Eigen::Index i = 0; i < count; ++i) {
        const double share = cue.density[i];
        const double ratio =
            cue.alternative ? std::min(share / (*cue.alternative)[i], kMaxRatio) : share * bins;
        table.push_back(static_cast<float>(ratio));
    }
    table.resize(std::max(table.size() + 1, kTableRoom));
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

/// The values of a cue in a row, or in some, and the ratio of each of their bins.
struct CueRow {
    const float* values;
    const FloatRange* range;
    const float* table;
};

/// Pixels whose bins are found before the first ratio is looked up, because numbers just stored can't be loaded at once.
constexpr std::ptrdiff_t kChunk = 256;

/// The ratios of a block of bins, from a table in registers that are as wide as a block.
TRICUE_INLINE void look_up_ratios(const float* table, const std::int32_t* bins, RowLanes<64>& ratios) {
    using Integers = Pack<std::int32_t, kRowBlock>;
    RowLanes<64> quarters[4], low, high;
    Integers places, low_bits, high_bits;
    load(bins, places);
    for (int k = 0; k < 4; ++k) load(table + k * kRowBlock, quarters[k]);
    look_up(quarters[0], quarters[1], places, low);
    look_up(quarters[2], quarters[3], places, high);
    load(&low, low_bits);
    load(&high, high_bits);
    // All ones from 32 on, and at 64, the bin without a measurement; comparisons would be done one by one.
    const Integers upper = (places << 26) >> 31, none = (places << 25) >> 31;
    low_bits = ((high_bits & upper) | (low_bits & ~upper)) & ~none;
    load(&low_bits, ratios);
}

/// The products of ratios that are looked up in registers, for n pixels, kRowBlock or more.
TRICUE_INLINE void multiply_in_registers(const CueRow* cues, std::size_t count, std::ptrdiff_t n,
                                         float* ratio) {
    std::int32_t bins[kMaxCues][kChunk];
    for (std::ptrdiff_t begin = 0; begin < n; begin += kChunk) {
        const std::ptrdiff_t length = std::min(kChunk, n), first = std::min(begin, n - length);
        for (std::size_t k = 0; k < count; ++k) {
            const FloatRange range = *cues[k].range;
            const float* values = cues[k].values + first;
            std::int32_t* found = bins[k];
            for_overlapping_blocks<kRowBlock>(
                length, [=](std::ptrdiff_t x) { found[x] = value_bin(values[x], range); });
        }
        for (std::ptrdiff_t x = 0; x < length; x += kRowBlock) {
            const std::ptrdiff_t at = std::min(x, length - kRowBlock);
            RowLanes<64> product, ratios;
            look_up_ratios(cues[0].table, bins[0] + at, product);
            for (std::size_t k = 1; k < count; ++k) {
                look_up_ratios(cues[k].table, bins[k] + at, ratios);
                product *= ratios;
            }
            store(product, ratio + first + at);
        }
    }
}

/// Multiplies n ratios by those of a cue's bins.
TRICUE_MULTIVERSION
void multiply_by(const std::int32_t* __restrict bins, int n, const float* __restrict table,
                 float* __restrict ratio) {
    for (int x = 0; x < n; ++x) ratio[x] *= table[bins[x]];
}

/// The products of ratios that are looked up one by one, for n pixels.
void multiply_one_by_one(const CueRow* cues, std::size_t count, std::ptrdiff_t n, float* ratio) {
    std::int32_t bins[kBandPixels];
    std::fill(ratio, ratio + n, 1.0F);
    for (std::ptrdiff_t begin = 0; begin < n; begin += kBandPixels) {
        const int length = static_cast<int>(std::min<std::ptrdiff_t>(kBandPixels, n - begin));
        for (std::size_t k = 0; k < count; ++k) {
            find_value_bins(cues[k].values + begin, length, *cues[k].range, bins);
            multiply_by(bins, length, cues[k].table, ratio + begin);
        }
    }
}

template <int kBytes>
TRICUE_INLINE void multiply_all(const CueRow* cues, std::size_t count, std::ptrdiff_t n, float* ratio) {
    bool small = kBytes == kRowBlock * sizeof(float) && n >= kRowBlock;
    for (std::size_t k = 0; k < count; ++k) small &= cues[k].range->none <= static_cast<int>(kTableRoom);
    if (small)
        multiply_in_registers(cues, count, n, ratio);
    else
        multiply_one_by_one(cues, count, n, ratio);
}

/// The products of the cues' ratios for n pixels.
TRICUE_MULTIWIDTH(multiply_ratios, multiply_all,
                  (const CueRow* cues, std::size_t count, std::ptrdiff_t n, float* ratio),
                  (cues, count, n, ratio))

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

TargetPixels target_pixels(const std::vector<Cue>& cues, const TargetPrior& prior, double threshold) {
    require_arguments(cues, threshold);
    const auto& [window, candidate] = prior;
    require_corners(window, "window");
    const PlaneView& first = cues[0].values;
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
    std::vector<float> ratio(static_cast<std::size_t>(band) * static_cast<std::size_t>(first.cols));
    const bool contiguous = std::all_of(cues.begin(), cues.end(),
                                        [](const Cue& cue) { return cue.values.stride == cue.values.cols; });
    std::vector<CueRow> inputs(cues.size());
    for (int y0 = visible.y0; y0 < visible.y1; y0 += band) {
        const int y1 = std::min(y0 + band, visible.y1), together = contiguous ? y1 - y0 : 1;
        for (int y = y0; y < y1; y += together) {
            for (std::size_t k = 0; k < cues.size(); ++k)
                inputs[k] = {cues[k].values.row(y), &ranges[k], tables[k].data()};
            multiply_ratios(inputs.data(), cues.size(), std::ptrdiff_t{together} * first.cols,
                            ratio.data() + std::ptrdiff_t{y - y0} * first.cols);
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
