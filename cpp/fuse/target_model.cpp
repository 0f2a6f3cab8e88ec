// SPDX-License-Identifier: MIT
#include "fuse/target_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/row_block.hpp"
#include "base/simd.hpp"
#include "fuse/detail/rectangle_pixels.hpp"
#include "fuse/detail/value_bins.hpp"
#include "fuse/target_distribution.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

constexpr std::size_t kMaxMaps = 3;
constexpr std::size_t kTables = 4;    // as in weighted_histogram, because neighbors mostly share a bin
constexpr float kMaxValue = 1e6F;     // of values in the sum of all weights; above any in an image
constexpr double kLeastSum = 1e-300;  // keeps a density of zeros from a division by 0
constexpr float kMaxFloat = std::numeric_limits<float>::max();

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

/// Of the pixels of a row, the same for all observations: the first place of each one's table; all ones where it is outside the
/// target; and where its weight counts, in histograms of flow and of disparity.
struct PixelRow {
    std::int32_t *table, *outside, *near, *counted;
};

/// Of the columns, the same for all rows: the first place of their tables for the target's pixels and for its surround; and all ones in
/// the columns of the window.
struct ColumnTables {
    std::int32_t *own, *other, *inside;
};

using Block = Pack<std::int32_t, kRowBlock>;

/// All ones where a label is 1, else 0.
TRICUE_INLINE void load_mask(const std::uint8_t* labels, Block& mask) {
    Pack<std::uint8_t, kRowBlock> bytes;
    Pack<std::uint16_t, kRowBlock> words;
    load(labels, bytes);
    convert(bytes, words);
    convert(words, mask);
    mask = -mask;
}

/// n is a whole number of blocks.
TRICUE_MULTIVERSION
void choose_tables(const std::uint8_t* target, const std::uint8_t* near, int n, const ColumnTables& columns,
                   bool inside_row, const PixelRow& out) {
    const std::int32_t row = inside_row ? -1 : 0;
    for (int x = 0; x < n; x += kRowBlock) {
        Block mine, close, own, other, inside;
        load_mask(target + x, mine);
        load_mask(near + x, close);
        load(columns.own + x, own);
        load(columns.other + x, other);
        load(columns.inside + x, inside);
        const Block outside = ~mine, counted = outside | (inside & row);
        store((mine & own) | (outside & other), out.table + x);
        store(outside, out.outside + x);
        store(counted & (outside | close), out.near + x);
        store(counted, out.counted + x);
    }
}

/// A row of an observation, and the mask where its weights count.
struct MapRow {
    const float *values, *weights;
    const std::int32_t* counted;
};

/// The place of each weight in the tables, with the weight if it counts, else 0; and the weights that count in all of the surround,
/// with zeros up to a whole number of blocks.
struct WeightRow {
    std::int32_t* slot;
    float *kept, *around;
};

/// Column by column of a block, because a sum in order would have to wait for each addition.
using BlockSums = std::array<double, kRowBlock>;

template <int kBytes>
TRICUE_INLINE void add_blocks(const float* weights, int n, BlockSums& sums) {
    constexpr int kLanes = kBytes / int{sizeof(double)}, kParts = kRowBlock / kLanes;
    Pack<double, kLanes> totals[std::size_t{kParts}], wide;
    Pack<float, kLanes> some;
    for (int part = 0; part < kParts; ++part) load(sums.data() + part * kLanes, totals[part]);
    for (int x = 0; x < n; x += kRowBlock)
        for (int part = 0; part < kParts; ++part) {
            load(weights + x + part * kLanes, some);
            convert(some, wide);
            totals[part] += wide;
        }
    for (int part = 0; part < kParts; ++part) store(totals[part], sums.data() + part * kLanes);
}

/// Adds the weights in all of the surround to `totals`.
template <int kBytes>
TRICUE_INLINE void place_weights_by(const MapRow& row, const PixelRow& pixels, int n, const FloatRange& range,
                                    const WeightRow& to, BlockSums& totals) {
    const MapRow from = row;
    const PixelRow at = pixels;
    const FloatRange bins = range;
    const WeightRow out = to;
    const auto place = [=](std::ptrdiff_t x) {
        const float value = from.values[x], weight = from.weights[x];
        const bool valid = (weight > 0.0F) & (weight <= kMaxFloat);
        const bool known = (value >= -kMaxValue) & (value < kMaxValue);
        out.slot[x] = value_bin(value, bins) + at.table[x];
        out.kept[x] = valid & (from.counted[x] != 0) ? weight : 0.0F;
        out.around[x] = valid & known & (at.outside[x] != 0) ? weight : 0.0F;
    };
    if (n < kRowBlock)
        for (int x = 0; x < n; ++x) place(x);
    else
        for (int begin = 0; begin < n; begin += kRowBlock) {
            const int first = std::min(begin, n - kRowBlock);
            // the rows don't overlap
            TRICUE_INDEPENDENT
            for (int x = first; x < first + kRowBlock; ++x) place(x);
        }
    add_blocks<kBytes>(out.around, n, totals);
}

TRICUE_MULTIWIDTH(place_weights, place_weights_by,
                  (const MapRow& row, const PixelRow& pixels, int n, const FloatRange& range,
                   const WeightRow& to, BlockSums& totals),
                  (row, pixels, n, range, to, totals))

/// Adds the weights of n pixels of kMaps observations to their tables. All at once, because neighbors mostly share a bin, and each
/// addition has to wait for the one before in the same place.
template <std::size_t kMaps>
void add_weights(const WeightRow* rows, double* const* tables, int n) {
    for (int x = 0; x < n; ++x)
        for (std::size_t k = 0; k < kMaps; ++k)
            tables[k][rows[k].slot[x]] += static_cast<double>(rows[k].kept[x]);
}

/// Sums of weights: in each bin of the target's window and of its surround, and in all of the surround.
struct Histograms {
    Vector target, surround;
    double total;
};

/// Room for a row of each observation, of a whole number of blocks.
class HistogramRows {
public:
    HistogramRows(std::size_t maps, int cols)
        : stride_(static_cast<std::size_t>(cols)),
          pixels_((7 + maps) * stride_),
          weights_(2 * maps * stride_) {}

    PixelRow pixels() { return {number(0), number(1), number(2), number(3)}; }
    ColumnTables columns() { return {number(4), number(5), number(6)}; }
    WeightRow map(std::size_t k) { return {number(7 + k), weight(2 * k), weight(2 * k + 1)}; }

private:
    std::int32_t* number(std::size_t i) { return pixels_.data() + i * stride_; }
    float* weight(std::size_t i) { return weights_.data() + i * stride_; }

    std::size_t stride_;
    std::vector<std::int32_t> pixels_;
    std::vector<float> weights_;
};

/// Both histograms of each observation in one pass, each as weighted_histogram sums it. Labels have room for whole blocks.
std::vector<Histograms> histograms(const std::vector<CueMap>& maps, const std::vector<ValueRange>& ranges,
                                   const Region& window, const Labels& target, const Labels& near) {
    const int rows = maps[0].values.rows, cols = maps[0].values.cols, bins = ranges[0].bins;
    const std::size_t count = maps.size(), size = static_cast<std::size_t>(bins) + 1;
    HistogramRows room(count, whole_blocks(cols));
    const PixelRow pixels = room.pixels();
    const ColumnTables columns = room.columns();
    for (int x = 0; x < cols; ++x) {
        columns.own[x] = ((x - window.x0) & 3) * (bins + 1);
        columns.other[x] = (4 + (x & 3)) * (bins + 1);
        columns.inside[x] = x >= window.x0 && x < window.x1 ? -1 : 0;
    }
    std::vector<double> sums(count * 2 * kTables * size);
    std::array<double*, kMaxMaps> tables{};
    std::array<WeightRow, kMaxMaps> weights{};
    std::array<BlockSums, kMaxMaps> totals{};
    std::vector<FloatRange> floats;
    for (std::size_t k = 0; k < count; ++k) {
        tables[k] = sums.data() + k * 2 * kTables * size;
        weights[k] = room.map(k);
        floats.emplace_back(ranges[k]);
    }
    const auto add = count == 1 ? add_weights<1> : count == 2 ? add_weights<2> : add_weights<3>;
    for (int y = 0; y < rows; ++y) {
        const bool inside = y >= window.y0 && y < window.y1;
        choose_tables(target.row(y).data(), near.row(y).data(), whole_blocks(cols), columns, inside, pixels);
        for (std::size_t k = 0; k < count; ++k) {
            const std::int32_t* counted = k + 1 < count ? pixels.near : pixels.counted;
            place_weights({maps[k].values.row(y), maps[k].weights.row(y), counted}, pixels, cols, floats[k],
                          weights[k], totals[k]);
        }
        add(weights.data(), tables.data(), cols);
    }
    std::vector<Histograms> found;
    for (std::size_t k = 0; k < count; ++k) {
        double total = 0.0;
        for (std::size_t i = 0; i < kRowBlock / 2; ++i) total += totals[k][i] + totals[k][kRowBlock / 2 + i];
        Histograms each{Vector(bins), Vector(bins), total};
        for (std::size_t i = 0; i + 1 < size; ++i) {
            const auto four = [&](std::size_t first) {
                const double* table = tables[k] + first * size + i;
                return (table[0] + table[size]) + (table[2 * size] + table[3 * size]);
            };
            each.target[static_cast<Index>(i)] = four(0);
            each.surround[static_cast<Index>(i)] = four(kTables);
        }
        found.push_back(std::move(each));
    }
    return found;
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
    return both / std::max(both.sum(), kLeastSum);
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
    const std::ptrdiff_t most = std::min(radius, bins - 1);
    for (std::ptrdiff_t j = -most; j <= most; ++j) {
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

Vector alternative(const Histograms& found, const Vector& gaussian, const HistogramRules& rules) {
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
    const std::vector<Histograms> all = histograms(maps, ranges, inside, target, near);
    Vector gaussian;
    TargetModel model{States(count, rules.bins), States(count, rules.bins), Vector(count)};
    for (Index i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double width = 2.0 * expected[k].half_range / rules.bins, middle = rules.bins / 2.0;
        const Histograms& found = all[k];
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
