// SPDX-License-Identifier: MIT
#include "cues/depth/segment_depth.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
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
#include "cues/depth/detail/depth_rows.hpp"
#include "cues/depth/detail/searched_distances.hpp"
#include "cues/depth/ground_distance.hpp"

namespace tricue {
namespace {

constexpr int kBins = 16;                 ///< in an object's distributions over columns and rows
constexpr Eigen::Index kMaxMinima = 254;  // labels have 8 bits

/// The distances of a row; and a copy with one more float at either end, infinite where nothing was measured. Returns whether
/// anything was measured.
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

/// Marks measured pixels that aren't edges.
TRICUE_MULTIVERSION
void mark_row(const float* __restrict distance, const float* __restrict above, const float* __restrict here,
              const float* __restrict below, int n, float gap, float slope, std::uint8_t* __restrict mask) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) {
        const float z = distance[x], nearest = smaller(smaller(above[x], here[x]), below[x]);
        mask[x] = has_depth(z) & !is_edge(z, nearest, gap, slope);
    });
}

/// The same for those that have changed.
TRICUE_MULTIVERSION
void mark_changed_row(const float* __restrict distance, const float* __restrict above,
                      const float* __restrict here, const float* __restrict below, int n, float gap,
                      float slope, const float* __restrict depth, const float* __restrict before, float noise,
                      float noise_slope, std::uint8_t* __restrict mask) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) {
        const float z = distance[x], nearest = smaller(smaller(above[x], here[x]), below[x]);
        mask[x] = has_depth(z) & !is_edge(z, nearest, gap, slope) &
                  has_changed(depth[x], before[x], noise, noise_slope);
    });
}

/// Reads a region of an image row by row: the distances of a row, and for each of three rows the nearest of each pixel and its
/// left and right neighbors.
class DistanceRows {
    template <typename Rows>
    static auto& of(Rows& rows, int y) {
        return rows[static_cast<std::size_t>(y + 3) % 3];
    }

public:
    /// Reads the region's columns and their neighbors, from the first row on.
    DistanceRows(const DepthView& depth, const Region& region, std::optional<GroundView> ground)
        : depth_(depth),
          first_(std::max(region.x0 - 1, 0)),
          count_(std::min(region.x1 + 1, depth.cols) - first_),
          ground_(std::move(ground)) {
        const auto n = static_cast<std::size_t>(depth.cols);
        distance_.fill(std::vector<float>(n));
        padded_.fill(std::vector<float>(n + 2, kUnmeasured));
        nearest_rows_.fill(std::vector<float>(n));
        unmeasured_.assign(n, kUnmeasured);
        nearest_.fill(unmeasured_.data());
        for (int y = region.y0 - 1; y <= region.y0 + 1; ++y) read(y);
        for (int y = region.y0 - 1; y <= region.y0; ++y) reduce(y);
    }

    /// Advances to the next row, y. Reads one row further, because numbers that have just been written can't be loaded yet
    /// at an offset of one.
    void next(int y) {
        read(y + 2);
        reduce(y + 1);
    }

    /// Whether anything was measured in the row: in most images some rows are all background.
    bool is_measured(int y) const { return of(measured_, y); }
    const float* distance(int y) const { return of(distance_, y).data(); }
    const float* nearest(int y) const { return of(nearest_, y); }

private:
    void read(int y) {
        bool& measured = of(measured_, y);
        measured = false;
        if (y < 0 || y >= depth_.rows) return;
        const float* depth = depth_.row(y) + first_;
        float *distance = of(distance_, y).data() + first_, *padded = of(padded_, y).data() + first_;
        if (ground_)
            measured = read_ground_row(depth, ground_->across.data() + first_, count_,
                                       ground_->down[static_cast<std::size_t>(y)], ground_->near,
                                       ground_->far, distance, padded);
        else
            measured = read_depth_row(depth, count_, distance, padded);
    }

    void reduce(int y) {
        float* row = of(nearest_rows_, y).data();
        if (is_measured(y)) nearest_in_row(of(padded_, y).data() + first_, count_, row + first_);
        of(nearest_, y) = is_measured(y) ? row : unmeasured_.data();
    }

    DepthView depth_;
    int first_, count_;  // columns
    std::optional<GroundView> ground_;
    std::vector<float> unmeasured_;
    std::array<std::vector<float>, 3> distance_, padded_, nearest_rows_;  // of three rows, in turn
    std::array<const float*, 3> nearest_;                                 // one of those, or unmeasured_
    std::array<bool, 3> measured_{};
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
    const bool changing = searched.before.rows > 0;
    std::optional<GroundView> ground;
    if (plane.size() > 2 && (plane.head(3) != 0.0).any())
        ground.emplace(depth.rows, depth.cols, camera, plane.head(3), divisions.levels.near,
                       divisions.levels.far);
    const int x0 = std::max(searched.region.x0, 0), x1 = std::min(searched.region.x1, depth.cols),
              y0 = std::max(searched.region.y0, 0), y1 = std::min(searched.region.y1, depth.rows);
    if (x0 >= x1 || y0 >= y1) return found;
    DistanceRows rows(depth, {x0, y0, x1, y1}, std::move(ground));
    std::vector<std::uint8_t> mask(static_cast<std::size_t>(depth.cols));
    const auto gap = static_cast<float>(divisions.gap), slope = static_cast<float>(divisions.slope),
               noise = static_cast<float>(searched.noise),
               noise_slope = static_cast<float>(searched.noise_slope);
    for (int y = y0; y < y1; ++y) {
        rows.next(y);
        if (!rows.is_measured(y)) continue;
        const float *distance = rows.distance(y) + x0, *above = rows.nearest(y - 1) + x0,
                    *here = rows.nearest(y) + x0, *below = rows.nearest(y + 1) + x0;
        if (changing)
            mark_changed_row(distance, above, here, below, x1 - x0, gap, slope, depth.row(y) + x0,
                             searched.before.row(y) + x0, noise, noise_slope, mask.data() + x0);
        else
            mark_row(distance, above, here, below, x1 - x0, gap, slope, mask.data() + x0);
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

/// Marks the sides at the edge of the measured region.
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
                           const Ground& ground, const Region& measured, const Divisions& divisions,
                           const Cut& cut) {
    require_arguments(depth, searched, divisions);
    const auto& [near, far, levels] = divisions.levels;
    SearchedDistances distances = find_distances(depth, searched, camera, ground.plane, divisions);
    PixelRuns runs = distances.runs(find_dividers(distances.histogram(divisions.levels), divisions),
                                    divisions.min_area == 1);
    auto found = describe_components(runs, depth, {near, far, 0, kBins}, divisions.min_area, false);
    Flags sides = cut_sides(depth, found.table, camera, cut);
    cut_at_edge(found.table, measured, cut.border, sides);
    States states = measure_objects({found.table, found.columns, found.rows, sides}, camera, ground);
    return {std::move(states), std::move(sides), std::move(found.columns), std::move(found.rows)};
}

}  // namespace tricue
