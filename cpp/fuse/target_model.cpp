// SPDX-License-Identifier: MIT
#include "fuse/target_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"
#include "fuse/detail/rectangle_pixels.hpp"
#include "fuse/detail/value_bins.hpp"
#include "fuse/target_distribution.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

constexpr std::size_t kTables = 4;  // as in weighted_histogram, because neighbors mostly share a bin
using Lanes = Pack<double, kTables>;
constexpr float kMaxReading = 1e6F;   // of readings in the sum of all weights; above any in an image
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
    if (maps.empty() || maps.size() > 3) refuse("maps", "1 to 3", std::to_string(maps.size()));
    if (expected.size() != maps.size())
        refuse("expected", std::to_string(maps.size()) + ", as many as maps",
               std::to_string(expected.size()));
    for (const CueMap& map : maps)
        for (const PlaneView& plane : {map.readings, map.weights})
            require_same_shape(plane, maps[0].readings, "maps");
    if (rules.bins < 2) refuse("bins", "2 to 65536", std::to_string(rules.bins));
    for (const ExpectedPeak& peak : expected) {
        require_range(range_of(peak, rules.bins));
        if (!(peak.deviation > 0.0)) refuse("expected", "deviations above 0", peak.deviation);
    }
    if (!(rules.smoothing > 0.0)) refuse("smoothing", "a number above 0", rules.smoothing);
    for (const auto& [share, name] :
         {std::pair{rules.memory, "memory"}, std::pair{rules.surround, "surround"}})
        if (!(share >= 0.0 && share < 1.0)) refuse(name, "a number in [0, 1)", share);
    if (blocks) {
        require_numbers(blocks->grid, blocks->states, "states");
        require_numbers(blocks->grid, blocks->trusted, "trusted");
    }
    if (before) require_former(*before, maps.size(), rules.bins);
}

/// (H, W) 1 at the target's pixels.
Labels target_mask(const std::optional<TargetBlocks>& blocks, int rows, int cols) {
    if (!blocks) return Labels::Ones(rows, cols);
    const auto& [grid, states, trusted] = *blocks;
    const std::vector<Region> all = block_pixels(grid, rows, cols);
    std::vector<Region> mine;
    for (Index i = 0; i < states.size(); ++i)
        if (states[i] == 1 && trusted[i] > 0) mine.push_back(all[static_cast<std::size_t>(i)]);
    return mask_regions(mine, rows, cols);
}

TRICUE_MULTIVERSION
void mark_near(const float* __restrict readings, float disparity, float tolerance, int n,
               std::uint8_t* __restrict near) {
    for_overlapping_blocks<16>(
        n, [=](std::ptrdiff_t x) { near[x] = !(std::abs(readings[x] - disparity) > tolerance); });
}

/// (H, W) 1 where flow counts: at the target's depth, or where no depth is known.
Labels depth_mask(const std::optional<DepthLimit>& depth, const PlaneView& disparity) {
    if (!depth) return Labels::Ones(disparity.rows, disparity.cols);
    Labels near(disparity.rows, disparity.cols);
    const auto middle = static_cast<float>(depth->disparity),
               tolerance = static_cast<float>(depth->tolerance);
    for (int y = 0; y < disparity.rows; ++y)
        mark_near(disparity.row(y), middle, tolerance, disparity.cols, near.row(y).data());
    return near;
}

/// A row of an observation: the bins of its readings, and which of its pixels are the target's and count for the target.
struct HistogramRow {
    const float *readings, *weights;
    const std::int32_t* bin;
    const std::uint8_t *target, *counted;
};

/// The destination of each weight: `slot` in the tables of the target, or those of its surround behind them; and the weights that
/// count in all of the surround.
struct WeightRow {
    std::int32_t* slot;
    float *kept, *around;
};

/// The columns where the weights of a row count for the target: begin <= x < end.
struct CountedColumns {
    int begin, end;
};

using Floats4 = Pack<float, kTables>;
using Ints4 = Pack<std::int32_t, kTables>;

/// The numbers where the mask is all ones, 0 where it is 0.
TRICUE_INLINE void keep_where(const Ints4& mask, const Floats4& numbers, float* out) {
    Ints4 bits;
    load(&numbers, bits);
    bits &= mask;
    store(bits, out);
}

TRICUE_INLINE void load_labels(const std::uint8_t* labels, Ints4& set) {
    Pack<std::uint8_t, kTables> bytes;
    load(labels, bytes);
    convert(bytes, set);
    set = set != 0;
}

/// The places of the bins of four pixels from column x on in all tables: those of the target by their columns, counted from `begin`.
TRICUE_INLINE void place_four(const HistogramRow& row, int x, const CountedColumns& counted,
                              std::int32_t size, const WeightRow& to) {
    Floats4 readings, weights;
    Ints4 bins, target, counts;
    load(row.readings + x, readings);
    load(row.weights + x, weights);
    load(row.bin + x, bins);
    load_labels(row.target + x, target);
    load_labels(row.counted + x, counts);
    const Ints4 columns = x + Ints4{0, 1, 2, 3},
                inside = (columns >= counted.begin) & (columns < counted.end);
    const Ints4 valid = (weights > 0.0F) & (weights <= kMaxFloat);
    const Ints4 known = (readings >= -kMaxReading) & (readings < kMaxReading);
    const Ints4 table = (target & ((columns - counted.begin) & 3)) | (~target & (4 + (columns & 3)));
    store(bins + table * size, to.slot + x);
    keep_where(valid & (~target | (inside & counts)), weights, to.kept + x);
    keep_where(valid & known & ~target, weights, to.around + x);
}

/// The same for fewer than four, which are copied to a place with room for reading four.
TRICUE_INLINE void place_few(const HistogramRow& row, int n, const CountedColumns& counted, std::int32_t size,
                             const WeightRow& to) {
    float readings[kTables] = {}, weights[kTables] = {};
    std::int32_t bins[kTables] = {};
    std::uint8_t target[kTables] = {}, counts[kTables] = {};
    std::copy_n(row.readings, n, readings);
    std::copy_n(row.weights, n, weights);
    std::copy_n(row.bin, n, bins);
    std::copy_n(row.target, n, target);
    std::copy_n(row.counted, n, counts);
    place_four({readings, weights, bins, target, counts}, 0, counted, size, to);
}

/// n pixels; the last four may begin earlier. The results have room for a multiple of four.
TRICUE_MULTIVERSION
void place_weights(const HistogramRow& row, int n, const CountedColumns& counted, std::int32_t size,
                   const WeightRow& to) {
    constexpr int kFour = kTables;
    const HistogramRow from = row;
    const WeightRow out = to;
    const CountedColumns columns = counted;
    if (n < 1) return;  // the results have no room then
    if (n < kFour) return place_few(from, n, columns, size, out);
    for (int x = 0; x < n; x += kFour) place_four(from, std::min(x, n - kFour), columns, size, out);
}

/// Adds a row to totals, four columns at a time; n is a multiple of four.
TRICUE_MULTIVERSION
void add_row(const float* numbers, std::size_t n, Lanes& totals) {
    Lanes sums = totals;
    for (std::size_t x = 0; x < n; x += kTables) {
        Floats4 four;
        Lanes wide;
        load(numbers + x, four);
        convert(four, wide);
        sums += wide;
    }
    totals = sums;
}

/// Sums of weights: in each bin of the target's window and of its surround, and in all of the surround.
struct Histograms {
    Vector target, surround;
    double total;
};

/// Both histograms of an observation in one pass, each as weighted_histogram sums it.
Histograms histograms(const CueMap& map, const ValueRange& range, const Region& window, const Labels& target,
                      const Labels& counted) {
    const int cols = map.readings.cols;
    const auto size = static_cast<std::size_t>(range.bins) + 1;
    const auto padded = (static_cast<std::size_t>(cols) + kTables - 1) / kTables * kTables;
    std::vector<std::int32_t> bin(static_cast<std::size_t>(cols)), slot(padded, range.bins);
    std::vector<float> kept(padded), around(padded);
    std::vector<double> sums(2 * kTables * size);
    Lanes totals{};
    for (int y = 0; y < map.readings.rows; ++y) {
        const float* readings = map.readings.row(y);
        find_value_bins(readings, cols, range, bin.data());
        const bool inside = y >= window.y0 && y < window.y1;
        place_weights({readings, map.weights.row(y), bin.data(), target.row(y).data(), counted.row(y).data()},
                      cols, {window.x0, inside ? window.x1 : window.x0}, static_cast<std::int32_t>(size),
                      {slot.data(), kept.data(), around.data()});
        add_row(around.data(), padded, totals);
        for (std::size_t x = 0; x < padded; ++x)
            sums[static_cast<std::size_t>(slot[x])] += static_cast<double>(kept[x]);
    }
    Histograms found{Vector(range.bins), Vector(range.bins), sum(totals)};
    for (std::size_t i = 0; i + 1 < size; ++i) {
        const auto four = [&](std::size_t first) {
            const double* table = sums.data() + first * size + i;
            return (table[0] + table[size]) + (table[2 * size] + table[3 * size]);
        };
        found.target[static_cast<Index>(i)] = four(0);
        found.surround[static_cast<Index>(i)] = four(kTables);
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

/// The histogram smoothed by a Gaussian of sum 1; weight that is spread beyond the ends is lost.
Vector smoothed(const Vector& histogram, double deviation) {
    const auto radius = static_cast<Index>(std::ceil(3.0 * deviation));
    Vector gaussian(2 * radius + 1);
    for (Index j = -radius; j <= radius; ++j) {
        const double step = static_cast<double>(j) / deviation;
        gaussian[radius + j] = std::exp(-0.5 * (step * step));
    }
    gaussian /= gaussian.sum();
    Vector smooth = Vector::Zero(histogram.size());
    for (Index i = 0; i < histogram.size(); ++i)
        for (Index j = std::max(i - radius, Index{0}); j <= std::min(i + radius, histogram.size() - 1); ++j)
            smooth[i] += histogram[j] * gaussian[radius + i - j];
    return smooth;
}

Vector alternative(const Histograms& found, const HistogramRules& rules) {
    const double uniform = 1.0 / rules.bins;
    if (!(rules.surround > 0.0 && found.total > 0.0)) return Vector::Constant(rules.bins, uniform);
    return rules.surround * smoothed(found.surround, rules.smoothing) / found.total +
           (1.0 - rules.surround) * uniform;
}

}  // namespace

TargetModel target_model(const std::vector<CueMap>& maps, const std::vector<ExpectedPeak>& expected,
                         const Rectangle& window, const std::optional<TargetBlocks>& blocks,
                         const std::optional<DepthLimit>& depth, const std::optional<FormerModel>& before,
                         const HistogramRules& rules) {
    require_arguments(maps, expected, blocks, before, rules);
    const PlaneView& last = maps.back().readings;
    const Region inside = rectangle_pixels(window, last.rows, last.cols, "window");
    const Labels target = target_mask(blocks, last.rows, last.cols);
    const Labels all = Labels::Ones(last.rows, last.cols), near = depth_mask(depth, last);
    const auto count = static_cast<Index>(maps.size());
    TargetModel model{States(count, rules.bins), States(count, rules.bins), Vector(count)};
    for (Index i = 0; i < count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const ValueRange range = range_of(expected[k], rules.bins);
        const double width = 2.0 * expected[k].half_range / rules.bins, middle = rules.bins / 2.0;
        const Histograms found = histograms(maps[k], range, inside, target, i + 1 < count ? near : all);
        auto [density, peak] = target_distribution(found.target, rules.smoothing, rules.ripple, middle,
                                                   expected[k].deviation / width);
        if (std::isnan(peak))
            peak = middle;
        else if (before && rules.memory > 0.0) {
            const double former = (before->peaks[k] - before->lows[k]) / width;
            density = blended(density, before->densities.row(i).data(), former - peak, rules.memory);
        }
        model.densities.row(i) = density;
        model.alternatives.row(i) = alternative(found, rules);
        model.peaks[i] = range.low + peak * width;
    }
    return model;
}

}  // namespace tricue
