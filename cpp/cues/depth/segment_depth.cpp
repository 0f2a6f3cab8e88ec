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
#include "cues/depth/detail/bit_image.hpp"
#include "cues/depth/ground_distance.hpp"
#include "cues/depth/measure_objects.hpp"

namespace tricue {
namespace {

constexpr int kBins = 16;
constexpr Eigen::Index kMaxMinima = 254;  // labels have 8 bits
constexpr float kUnmeasured = std::numeric_limits<float>::infinity();

constexpr int kBlock = 64;  ///< pixels, so that loops over them have no remainder
/// Of an image's pixels an eighth or fewer are searched, before a camera that doesn't move.
constexpr int kUsualShare = 8;

/// A row of which a fourth or less is searched is listed.
constexpr int kListedShare = 4;

/// Neighbors mostly share a level, and reading a count that was just written is slow: so they count in different tables.
constexpr std::size_t kTables = 4;

inline float smaller(float a, float b) {
    return a < b ? a : b;
}

/// The distances of a row; and with one more float at either end, infinite where nothing was measured. Returns whether anything was.
TRICUE_MULTIVERSION
bool read_ground_row(const float* __restrict depth, const double* __restrict across, int n, double down,
                     float near, float far, float* __restrict distance, float* __restrict padded) {
    std::int32_t any = 0;
    for_overlapping_blocks(n, [=, &any](std::ptrdiff_t u) {
        const float along = along_ground(depth[u], down + across[u], near, far);
        distance[u] = along;
        padded[u + 1] = has_depth(along) ? along : kUnmeasured;
        any |= has_depth(along);
    });
    return any != 0;
}

TRICUE_MULTIVERSION
bool read_depth_row(const float* __restrict depth, int n, float* __restrict distance,
                    float* __restrict padded) {
    std::int32_t any = 0;
    for_overlapping_blocks(n, [=, &any](std::ptrdiff_t u) {
        distance[u] = depth[u];
        padded[u + 1] = has_depth(depth[u]) ? depth[u] : kUnmeasured;
        any |= has_depth(depth[u]);
    });
    return any != 0;
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
void find_levels(const float* __restrict distance, const LevelScale& levels, std::int32_t* __restrict level) {
    const float least = levels.least, end = levels.end, near = levels.near, scale = levels.scale,
                top = levels.top;
    const std::int32_t none = levels.none;
    for (int x = 0; x < kBlock; ++x) {
        const float z = distance[x], place = (z - near) * scale;
        const bool counts = (z >= least) & (z < end);
        const float within = counts & (place < top) ? place : top;
        level[x] = counts ? static_cast<std::int32_t>(within) : none;
    }
}

/// The labels of a block, 0 beyond the dividers. As these ascend, a distance has the label of the last that it has reached.
TRICUE_MULTIVERSION
void divide(const float* __restrict distance, const float* __restrict dividers, int divisions,
            std::uint8_t* __restrict labels) {
    const float end = dividers[divisions];
    for (int x = 0; x < kBlock; ++x) labels[x] = 0;
    for (int k = 0; k < divisions; ++k) {
        const float least = dividers[k];
        const auto label = static_cast<std::uint8_t>(k + 1);
        for (int x = 0; x < kBlock; ++x) labels[x] = distance[x] >= least ? label : labels[x];
    }
    for (int x = 0; x < kBlock; ++x) labels[x] = distance[x] < end ? labels[x] : std::uint8_t{0};
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
        nearest_rows_.fill(std::vector<float>(n));
        unmeasured_.assign(n, kUnmeasured);
        nearest_.fill(unmeasured_.data());
        read(0);
        read(1);
        reduce(0);
    }

    /// Of the next row, which is y. One row further is read: numbers that have just been written can't be loaded yet, shifted by one.
    void next(int y) {
        read(y + 2);
        reduce(y + 1);
    }

    /// Whether anything was measured in it: in most images some rows are all background.
    bool is_measured(int y) const { return of(measured_, y); }
    const float* distance(int y) const { return of(distance_, y).data(); }
    const float* nearest(int y) const { return of(nearest_, y); }

private:
    void read(int y) {
        bool& measured = of(measured_, y);
        measured = false;
        if (y >= depth_.rows) return;
        float *distance = of(distance_, y).data(), *padded = of(padded_, y).data();
        if (ground_)
            measured = read_ground_row(depth_.row(y), ground_->across.data(), depth_.cols,
                                       ground_->down[static_cast<std::size_t>(y)], ground_->near,
                                       ground_->far, distance, padded);
        else
            measured = read_depth_row(depth_.row(y), depth_.cols, distance, padded);
    }

    void reduce(int y) {
        float* row = of(nearest_rows_, y).data();
        if (is_measured(y)) nearest_in_row(of(padded_, y).data(), depth_.cols, row);
        of(nearest_, y) = is_measured(y) ? row : unmeasured_.data();
    }

    DepthView depth_;
    std::optional<GroundView> ground_;
    std::vector<float> unmeasured_;
    std::array<std::vector<float>, 3> distance_, padded_, nearest_rows_;  // of three rows, in turn
    std::array<const float*, 3> nearest_;                                 // one of those, or unmeasured_
    std::array<bool, 3> measured_{};
};

TRICUE_MULTIVERSION
int count_pixels(const BitImage& mask, int y) {
    int count = 0;
    for (int i = 0; i < mask.words(); ++i) count += count_bits(mask.word(y, i));
    return count;
}

/// Lists the columns of the pixels of a row that are set, and their distances.
TRICUE_MULTIVERSION
void list_pixels(const BitImage& mask, int y, const float* distance, std::int32_t* columns, float* to) {
    std::int32_t* end = columns;
    for (int i = 0; i < mask.words(); ++i) end = list_bits<8>(mask.word(y, i), std::int32_t{i * kBlock}, end);
    for (; columns != end; ++columns, ++to) *to = distance[*columns];
}

/// The distances of a whole row, infinite where its mask is 0.
TRICUE_MULTIVERSION
void mask_distances(const float* __restrict distance, const std::uint8_t* __restrict mask, int n,
                    float* __restrict to) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) { to[x] = mask[x] ? distance[x] : kUnmeasured; });
}

/// Whether each label isn't that of the pixel before it. Returns whether that is so anywhere.
TRICUE_MULTIVERSION
bool mark_changes(const std::uint8_t* __restrict labels, int n, std::uint8_t* __restrict changes) {
    std::uint8_t any = 0;
    changes[0] = 0;
    for (int x = 1; x < n; ++x) any |= changes[x] = labels[x] != labels[x - 1];
    return any != 0;
}

/// The same of pixels that are listed: whether each one's left neighbor is listed, too, and has another label.
TRICUE_MULTIVERSION
bool mark_listed_changes(const std::uint8_t* __restrict labels, const std::int32_t* __restrict columns, int n,
                         std::uint8_t* __restrict changes) {
    std::uint8_t any = 0;
    changes[0] = 0;
    for (int i = 1; i < n; ++i)
        any |= changes[i] = (labels[i] != labels[i - 1]) & (columns[i] == columns[i - 1] + 1);
    return any != 0;
}

/// The distances of the pixels where objects are looked for, row by row.
///
/// Before a camera that doesn't move these pixels are few, and apart: then they are listed. A row with many is kept whole, with
/// infinite distances at its others: to list them takes longer than to divide all.
class SearchedDistances {
public:
    SearchedDistances(int rows, int cols)
        : rows_(rows), cols_(cols), bits_(rows, cols), counts_(static_cast<std::size_t>(rows)) {
        const std::ptrdiff_t usual = rows * std::ptrdiff_t{cols} / kUsualShare;
        make_room(usual, columns_);
        make_room(usual, distances_);
    }

    /// Those of a row whose mask isn't 0; row after row.
    void add_row(int y, const float* distance, const std::uint8_t* mask) {
        bits_.read(y, mask);
        int count = count_pixels(bits_, y);
        make_room(size_ + cols_, distances_);
        float* to = distances_.data() + size_;
        if (count > cols_ / kListedShare) {
            mask_distances(distance, mask, count = cols_, to);
        } else {
            make_room(listed_ + count, columns_);
            list_pixels(bits_, y, distance, columns_.data() + listed_, to);
            listed_ += count;
        }
        counts_[static_cast<std::size_t>(y)] = count;
        size_ += count;
    }

    Vector histogram(const DepthLevels& levels) {
        const LevelScale scale(levels);
        const auto bins = static_cast<std::size_t>(levels.count) + 1;
        std::vector<std::int32_t> counts(kTables * bins);
        std::array<std::int32_t, kBlock> level;
        fill_last_block();
        for (std::ptrdiff_t first = 0; first < size_; first += kBlock) {
            find_levels(distances_.data() + first, scale, level.data());
            for (std::size_t i = 0; i < kBlock; ++i)
                ++counts[(i % kTables) * bins + static_cast<std::size_t>(level[i])];
        }
        Vector histogram = Vector::Zero(levels.count);
        for (std::size_t t = 0; t < kTables; ++t)
            for (Eigen::Index i = 0; i < histogram.size(); ++i)
                histogram[i] += static_cast<double>(counts[t * bins + static_cast<std::size_t>(i)]);
        return histogram;
    }

    /// The runs of pixels in the same division; without pixels that are alone, unless these count.
    PixelRuns runs(VectorRef dividers, bool single) {
        std::vector<float> limits;
        for (const double s : dividers) limits.push_back(round_up_to_float(s));
        const auto label = [&limits](const float* distances, int count, std::uint8_t* labels) {
            for (int first = 0; first < count; first += kBlock)
                divide(distances + first, limits.data(), static_cast<int>(limits.size()) - 1, labels + first);
        };
        const std::size_t pixels = static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_);
        std::vector<std::uint8_t> image(pixels + kBlock), changed(static_cast<std::size_t>(cols_) + kBlock),
            few(changed.size());
        BitImage changes(rows_, cols_);
        fill_last_block();
        const float* distances = distances_.data();
        const std::int32_t* columns = columns_.data();
        for (int y = 0; y < rows_; ++y) {
            const int count = counts_[static_cast<std::size_t>(y)];
            if (count == 0) continue;
            std::uint8_t* row = image.data() + y * std::ptrdiff_t{cols_};
            if (count == cols_) {
                label(distances, count, row);
                bits_.read(y, row);
                if (mark_changes(row, cols_, changed.data())) changes.read(y, changed.data());
            } else {
                label(distances, count, few.data());
                add_labels(y, few.data(), columns, count, row);
                if (mark_listed_changes(few.data(), columns, count, changed.data()))
                    for (int i = 0; i < count; ++i)
                        if (changed[static_cast<std::size_t>(i)]) changes.set(y, columns[i]);
                columns += count;
            }
            distances += count;
        }
        return label_runs(bits_, changes, {image.data(), rows_, cols_, 1, cols_}, single);
    }

private:
    /// Memory as it is needed, and a block more: that of a whole image is fetched from the system anew in every frame.
    template <typename Numbers>
    static void make_room(std::ptrdiff_t pixels, Numbers& numbers) {
        if (pixels + kBlock > numbers.size())
            numbers.conservativeResize(std::max(pixels + kBlock, 2 * numbers.size()));
    }

    /// Those of pixels that are listed, into a row of which nothing else is read. What is in no division is searched no longer.
    void add_labels(int y, const std::uint8_t* labels, const std::int32_t* columns, int count,
                    std::uint8_t* row) {
        const bool all = std::memchr(labels, 0, std::size_t{static_cast<unsigned>(count)}) == nullptr;
        if (!all) std::fill_n(row, cols_, std::uint8_t{0});
        for (int i = 0; i < count; ++i) row[columns[i]] = labels[i];
        if (!all) bits_.read(y, row);
    }

    /// Distances that don't count, up to a whole block.
    void fill_last_block() { distances_.segment(size_, kBlock) = kUnmeasured; }

    int rows_, cols_;
    BitImage bits_;
    std::vector<int> counts_;   ///< of each row; of a whole one all of it
    Eigen::ArrayXi columns_;    ///< of the pixels that are listed; used as far as listed_
    Eigen::ArrayXf distances_;  ///< used as far as size_
    std::ptrdiff_t listed_ = 0, size_ = 0;
};

void require_arguments(const DepthView& depth, const SearchedPixels& searched, const Divisions& divisions) {
    const DepthView& before = searched.before;
    if (before.rows > 0 || before.cols > 0) require_same_shape(before, depth, "before");
    require_noise(searched.noise, searched.noise_slope);
    require_gap(divisions.gap, divisions.slope);
    require_levels(divisions.levels);
    if (divisions.levels.near < 0.0) refuse("near", "a finite number, not negative", divisions.levels.near);
    if (divisions.min_area < 1) refuse("min_area", "at least 1", divisions.min_area);
}

SearchedDistances find_distances(const DepthView& depth, const SearchedPixels& searched, VectorRef camera,
                                 VectorRef plane, const Divisions& divisions) {
    SearchedDistances found(depth.rows, depth.cols);
    DistanceRows rows(depth, camera, plane, divisions.levels);
    const bool changing = searched.before.rows > 0;
    const int x0 = std::min(std::max(searched.region.x0, 0), depth.cols),
              x1 = std::min(searched.region.x1, depth.cols);
    std::vector<std::uint8_t> mask(static_cast<std::size_t>(depth.cols));
    for (int y = 0; y < depth.rows; ++y) {
        rows.next(y);
        const bool inside = y >= searched.region.y0 && y < searched.region.y1 && x0 < x1;
        if (!inside || !rows.is_measured(y)) continue;
        mark_row(rows.distance(y), rows.nearest(y - 1), rows.nearest(y), rows.nearest(y + 1), depth.cols,
                 static_cast<float>(divisions.gap), static_cast<float>(divisions.slope), mask.data());
        if (changing)
            keep_changed(depth.row(y), searched.before.row(y), depth.cols, static_cast<float>(searched.noise),
                         static_cast<float>(searched.noise_slope), mask.data());
        std::fill(mask.begin(), mask.begin() + x0, std::uint8_t{0});
        std::fill(mask.begin() + x1, mask.end(), std::uint8_t{0});
        found.add_row(y, rows.distance(y), mask.data());
    }
    return found;
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
    SearchedDistances distances = find_distances(depth, searched, camera, plane, divisions);
    PixelRuns runs = distances.runs(find_dividers(distances.histogram(divisions.levels), divisions),
                                    divisions.min_area == 1);
    auto found = describe_components(runs, depth, {near, far, 0, kBins}, divisions.min_area, false);
    Flags sides = cut_sides(depth, found.table, camera, cut);
    cut_at_edge(found.table, measured, cut.border, sides);
    States states = measure_objects({found.table, found.columns, found.rows, sides}, camera,
                                    {plane, standing.feet, standing.legs});
    return {std::move(states), std::move(sides), std::move(found.columns), std::move(found.rows)};
}

}  // namespace tricue
