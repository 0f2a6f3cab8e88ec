// SPDX-License-Identifier: MIT
#include "cues/depth/segment_depth.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"
#include "cues/depth/changed_depth.hpp"
#include "cues/depth/density_extrema.hpp"
#include "cues/depth/depth_components.hpp"
#include "cues/depth/depth_density.hpp"
#include "cues/depth/depth_edges.hpp"
#include "cues/depth/ground_distance.hpp"
#include "cues/depth/measure_objects.hpp"

namespace tricue {
namespace {

constexpr int kBins = 16;
constexpr Eigen::Index kMaxMinima = 254;  // labels have 8 bits
constexpr float kUnmeasured = std::numeric_limits<float>::infinity();

/// Most pixels of a frame are left out: they are skipped by the block.
constexpr int kBlock = 64;
constexpr int kWord = sizeof(std::uint64_t);

/// Neighbors mostly share a level, and reading a count that was just written is slow: so they count in different tables.
constexpr std::size_t kTables = 4;

inline float smaller(float a, float b) {
    return a < b ? a : b;
}

/// The distances of a row; and with one more float at either end, infinite where nothing was measured.
TRICUE_MULTIVERSION
void read_ground_row(const float* __restrict depth, const double* __restrict across, int n, double down,
                     float near, float far, float* __restrict distance, float* __restrict padded) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t u) {
        const float along = along_ground(depth[u], down + across[u], near, far);
        distance[u] = along;
        padded[u + 1] = has_depth(along) ? along : kUnmeasured;
    });
}

TRICUE_MULTIVERSION
void read_depth_row(const float* __restrict depth, int n, float* __restrict distance,
                    float* __restrict padded) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t u) {
        distance[u] = depth[u];
        padded[u + 1] = has_depth(depth[u]) ? depth[u] : kUnmeasured;
    });
}

/// The nearest of each pixel and its neighbors left and right.
TRICUE_MULTIVERSION
void nearest_in_row(const float* __restrict padded, int n, float* __restrict nearest) {
    for_overlapping_blocks(
        n, [=](std::ptrdiff_t x) { nearest[x] = smaller(smaller(padded[x], padded[x + 1]), padded[x + 2]); });
}

/// Measured pixels that are no edge.
TRICUE_MULTIVERSION
void mark_row(const float* __restrict distance, const float* __restrict above, const float* __restrict here,
              const float* __restrict below, int n, float gap, float slope, std::uint8_t* __restrict mask) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) {
        const float z = distance[x], nearest = smaller(smaller(above[x], here[x]), below[x]);
        mask[x] = has_depth(z) & !is_edge(z, nearest, gap, slope);
    });
}

/// Those that have changed.
TRICUE_MULTIVERSION
void keep_changed(const float* __restrict depth, const float* __restrict before, int n, float noise,
                  float slope, std::uint8_t* __restrict mask) {
    for_overlapping_blocks(
        n, [=](std::ptrdiff_t x) { mask[x] &= has_changed(depth[x], before[x], noise, slope); });
}

/// A histogram's levels, as depth_histogram finds them.
struct LevelScale {
    float least, end, near, scale, top;
    std::int32_t none;

    explicit LevelScale(const DepthLevels& levels)
        : least(round_up_to_float(levels.near)),
          end(round_up_to_float(levels.far)),
          near(static_cast<float>(levels.near)),
          scale(static_cast<float>(levels.count / (levels.far - levels.near))),
          top(static_cast<float>(levels.count - 1)),
          none(levels.count) {}
};

/// The levels of a block, `none` where a pixel doesn't count.
TRICUE_MULTIVERSION
void find_levels(const float* __restrict distance, const std::uint8_t* __restrict mask,
                 const LevelScale& levels, std::int32_t* __restrict level) {
    const float least = levels.least, end = levels.end, near = levels.near, scale = levels.scale,
                top = levels.top;
    const std::int32_t none = levels.none;
    for (int x = 0; x < kBlock; ++x) {
        const float z = distance[x], place = (z - near) * scale;
        const bool counts = (mask[x] != 0) & (z >= least) & (z < end);
        const float within = counts & (place < top) ? place : top;
        level[x] = counts ? static_cast<std::int32_t>(within) : none;
    }
}

/// The labels of a block, 0 where a pixel has none. As the dividers ascend, a distance has the label of the last that it has reached.
TRICUE_MULTIVERSION
void divide(const float* __restrict distance, const std::uint8_t* __restrict mask,
            const float* __restrict dividers, int divisions, std::uint8_t* __restrict labels) {
    const float end = dividers[divisions];
    for (int x = 0; x < kBlock; ++x) labels[x] = 0;
    for (int k = 0; k < divisions; ++k) {
        const float least = dividers[k];
        const auto label = static_cast<std::uint8_t>(k + 1);
        for (int x = 0; x < kBlock; ++x) labels[x] = distance[x] >= least ? label : labels[x];
    }
    for (int x = 0; x < kBlock; ++x)
        labels[x] = (mask[x] != 0) & (distance[x] < end) ? labels[x] : std::uint8_t{0};
}

std::uint64_t word_at(const std::uint8_t* flags) {
    std::uint64_t word;
    std::memcpy(&word, flags, kWord);
    return word;
}

/// Reads an image row by row: the distances of one, and the nearest of each pixel's neighborhood in three rows.
class DistanceRows {
    template <typename Rows>
    static auto& of(Rows& rows, int y) {
        return rows[static_cast<std::size_t>(y + 3) % 3];
    }

public:
    DistanceRows(const DepthView& depth, VectorRef camera, VectorRef plane, const DepthLevels& range)
        : depth_(depth) {
        if (plane.size() > 2 && (plane.head(3) != 0.0).any())
            ground_.emplace(depth.rows, depth.cols, camera, plane.head(3), range.near, range.far);
        const auto n = static_cast<std::size_t>(depth.cols);
        distance_.fill(std::vector<float>(n));
        padded_.fill(std::vector<float>(n + 2, kUnmeasured));
        nearest_.fill(std::vector<float>(n, kUnmeasured));
        read(0);
        read(1);
        reduce(0);
    }

    /// Of the next row, which is y. One row further is read: numbers that have just been written can't be loaded yet, shifted by one.
    void next(int y) {
        read(y + 2);
        reduce(y + 1);
    }

    const float* distance(int y) const { return of(distance_, y).data(); }
    const float* nearest(int y) const { return of(nearest_, y).data(); }

private:
    void read(int y) {
        if (y >= depth_.rows) return;
        float *distance = of(distance_, y).data(), *padded = of(padded_, y).data();
        if (ground_)
            read_ground_row(depth_.row(y), ground_->across.data(), depth_.cols,
                            ground_->down[static_cast<std::size_t>(y)], ground_->near, ground_->far, distance,
                            padded);
        else
            read_depth_row(depth_.row(y), depth_.cols, distance, padded);
    }

    void reduce(int y) {
        auto& nearest = of(nearest_, y);
        if (y < depth_.rows)
            nearest_in_row(of(padded_, y).data(), depth_.cols, nearest.data());
        else
            std::fill(nearest.begin(), nearest.end(), kUnmeasured);
    }

    DepthView depth_;
    std::optional<GroundView> ground_;
    std::array<std::vector<float>, 3> distance_, padded_, nearest_;  // of three rows, in turn
};

/// Blocks of pixels among which are some where objects are looked for. Of all others nothing is kept.
class Blocks {
public:
    explicit Blocks(int cols) : cols_(cols) {}

    /// Those of a row, whose mask has zeros up to a whole block.
    void add_row(int y, const float* distance, const std::uint8_t* mask) {
        for (int x = 0; x < cols_; x += kBlock) {
            std::uint64_t any = 0, bits = 0;
            for (int i = 0; i < kBlock; i += kWord) any |= word_at(mask + x + i);
            if (any == 0) continue;
            for (int i = 0; i < kBlock; i += kWord) bits |= nonzero_bytes(word_at(mask + x + i)) << i;
            places_.push_back({y, x});
            bits_.push_back(bits);
            masks_.insert(masks_.end(), mask + x, mask + x + kBlock);
            distances_.insert(distances_.end(), distance + x, distance + std::min(x + kBlock, cols_));
            distances_.resize(places_.size() * kBlock);
        }
    }

    Vector histogram(const DepthLevels& levels) const {
        const LevelScale scale(levels);
        const auto bins = static_cast<std::size_t>(levels.count) + 1;
        std::vector<std::int32_t> counts(kTables * bins);
        std::array<std::int32_t, kBlock> level;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            find_levels(distance(i), mask(i), scale, level.data());
            if (bits_[i] == ~std::uint64_t{0}) {
                for (std::size_t x = 0; x < kBlock; ++x)
                    ++counts[(x % kTables) * bins + static_cast<std::size_t>(level[x])];
                continue;
            }
            std::size_t table = 0;
            for (std::uint64_t bits = bits_[i]; bits != 0; bits &= bits - 1, table = (table + 1) % kTables)
                ++counts[table * bins +
                         static_cast<std::size_t>(level[static_cast<std::size_t>(lowest_bit(bits))])];
        }
        Vector histogram = Vector::Zero(levels.count);
        for (std::size_t t = 0; t < kTables; ++t)
            for (Eigen::Index i = 0; i < histogram.size(); ++i)
                histogram[i] += static_cast<double>(counts[t * bins + static_cast<std::size_t>(i)]);
        return histogram;
    }

    Labels label(int rows, VectorRef dividers) const {
        std::vector<float> limits;
        for (const double s : dividers) limits.push_back(round_up_to_float(s));
        Labels labels = Labels::Zero(rows, cols_);
        std::array<std::uint8_t, kBlock> block;
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const auto [y, x] = places_[i];
            divide(distance(i), mask(i), limits.data(), static_cast<int>(limits.size()) - 1, block.data());
            std::copy_n(block.data(), std::min(kBlock, cols_ - x), labels.row(y).data() + x);
        }
        return labels;
    }

private:
    struct Place {
        int row, first;
    };

    const float* distance(std::size_t i) const { return distances_.data() + i * kBlock; }
    const std::uint8_t* mask(std::size_t i) const { return masks_.data() + i * kBlock; }

    int cols_;
    std::vector<Place> places_;
    std::vector<std::uint64_t> bits_;  ///< of the masks
    std::vector<float> distances_;
    std::vector<std::uint8_t> masks_;
};

void require_arguments(const DepthView& depth, const SearchedPixels& searched, const Divisions& divisions) {
    const DepthView& before = searched.before;
    if (before.rows > 0 || before.cols > 0) require_same_shape(before, depth, "before");
    require_noise(searched.noise, searched.noise_slope);
    require_gap(divisions.gap, divisions.slope);
    require_levels(divisions.levels);
}

Blocks find_blocks(const DepthView& depth, const SearchedPixels& searched, VectorRef camera, VectorRef plane,
                   const Divisions& divisions) {
    Blocks blocks(depth.cols);
    DistanceRows rows(depth, camera, plane, divisions.levels);
    const bool changing = searched.before.rows > 0;
    const int x0 = std::min(std::max(searched.region.x0, 0), depth.cols),
              x1 = std::min(searched.region.x1, depth.cols);
    const auto whole = static_cast<std::size_t>((depth.cols + kBlock - 1) / kBlock * kBlock);
    std::vector<std::uint8_t> mask(whole);
    for (int y = 0; y < depth.rows; ++y) {
        rows.next(y);
        if (y < searched.region.y0 || y >= searched.region.y1 || x0 >= x1) continue;
        mark_row(rows.distance(y), rows.nearest(y - 1), rows.nearest(y), rows.nearest(y + 1), depth.cols,
                 static_cast<float>(divisions.gap), static_cast<float>(divisions.slope), mask.data());
        if (changing)
            keep_changed(depth.row(y), searched.before.row(y), depth.cols, static_cast<float>(searched.noise),
                         static_cast<float>(searched.noise_slope), mask.data());
        std::fill(mask.begin(), mask.begin() + x0, std::uint8_t{0});
        std::fill(mask.begin() + x1, mask.end(), std::uint8_t{0});
        blocks.add_row(y, rows.distance(y), mask.data());
    }
    return blocks;
}

Vector find_dividers(const Vector& histogram, const Divisions& divisions) {
    const auto& [near, far, levels] = divisions.levels;
    const Vector density = depth_density(histogram, divisions.bandwidth);
    const Indices minima = density_extrema(density, divisions.prominence * density.maxCoeff()).minima;
    const Eigen::Index count = std::min(minima.size(), kMaxMinima);
    const double level = (far - near) / levels;
    Vector dividers(count + 2);
    dividers[0] = near;
    for (Eigen::Index i = 0; i < count; ++i)
        dividers[i + 1] = near + (static_cast<double>(minima[i]) + 0.5) * level;
    dividers[count + 1] = far;
    return dividers;
}

/// Marks the sides at the edge of what was measured.
void cut_at_edge(StatesRef table, const Region& measured, int border, Flags& cut) {
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
        const double x = table(i, 0), y = table(i, 1), w = table(i, 2), h = table(i, 3);
        const double gaps[] = {x - measured.x0, measured.x1 - (x + w), y - measured.y0,
                               measured.y1 - (y + h)};
        for (Eigen::Index side = 0; side < 4; ++side) cut(i, side) |= gaps[side] < border;
    }
}

}  // namespace

DepthObjects segment_depth(const DepthView& depth, const SearchedPixels& searched, VectorRef camera,
                           VectorRef plane, const Region& measured, const Divisions& divisions,
                           const Cut& cut, const Standing& standing) {
    require_arguments(depth, searched, divisions);
    const auto& [near, far, levels] = divisions.levels;
    const Blocks blocks = find_blocks(depth, searched, camera, plane, divisions);
    const Labels labels =
        blocks.label(depth.rows, find_dividers(blocks.histogram(divisions.levels), divisions));
    auto found = depth_components({labels.data(), depth.rows, depth.cols, 1, depth.cols}, depth,
                                  {near, far, 0, kBins}, divisions.min_area, false);
    Flags sides = cut_sides(depth, found.table, camera, cut);
    cut_at_edge(found.table, measured, cut.border, sides);
    States states = measure_objects({found.table, found.columns, found.rows, sides}, camera,
                                    {plane, standing.feet, standing.legs});
    return {std::move(states), std::move(sides), std::move(found.columns), std::move(found.rows)};
}

}  // namespace tricue
