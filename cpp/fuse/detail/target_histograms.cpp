// SPDX-License-Identifier: MIT
#include "fuse/detail/target_histograms.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/row_block.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

constexpr std::size_t kTables = 4;  // as in weighted_histogram, because neighbors mostly share a bin
constexpr float kMaxValue = 1e6F;   // of values in the sum of all weights; above any in an image
constexpr float kMaxFloat = std::numeric_limits<float>::max();

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

}  // namespace

std::vector<WindowHistograms> sum_histograms(const std::vector<CueMap>& maps,
                                             const std::vector<ValueRange>& ranges, const Region& window,
                                             const Labels& target, const Labels& near) {
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
    std::vector<WindowHistograms> found;
    for (std::size_t k = 0; k < count; ++k) {
        double total = 0.0;
        for (std::size_t i = 0; i < kRowBlock / 2; ++i) total += totals[k][i] + totals[k][kRowBlock / 2 + i];
        WindowHistograms each{Vector(bins), Vector(bins), total};
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

}  // namespace tricue
