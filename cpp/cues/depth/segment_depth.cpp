// SPDX-License-Identifier: MIT
#include "cues/depth/segment_depth.hpp"

#include <algorithm>
#include <cstdint>

#include "base/depth_pixels.hpp"
#include "base/simd.hpp"
#include "cues/depth/density_extrema.hpp"
#include "cues/depth/depth_components.hpp"
#include "cues/depth/depth_density.hpp"
#include "cues/depth/depth_edges.hpp"
#include "cues/depth/divide_depth.hpp"
#include "cues/depth/ground_distance.hpp"
#include "cues/depth/measure_objects.hpp"

namespace tricue {
namespace {

constexpr int kBins = 16;
constexpr Eigen::Index kMaxMinima = 254;  // labels have 8 bits

/// Edges become a mask: 1 where there is none, and an object is looked for.
TRICUE_MULTIVERSION
void leave_out(const std::uint8_t* __restrict free, std::ptrdiff_t n, std::uint8_t* __restrict edges) {
    for (std::ptrdiff_t i = 0; i < n; ++i) edges[i] = (free[i] != 0) & (edges[i] == 0);
}

TRICUE_MULTIVERSION
void invert(std::ptrdiff_t n, std::uint8_t* __restrict edges) {
    for (std::ptrdiff_t i = 0; i < n; ++i) edges[i] ^= 1;
}

Labels find_mask(const DepthView& distance, const ImageView& free, const Divisions& divisions) {
    Labels mask = depth_edges(distance, divisions.gap, divisions.slope);
    if (free.rows == 0 && free.cols == 0) {
        invert(mask.size(), mask.data());
        return mask;
    }
    require_mask(free, distance);
    for (int y = 0; y < distance.rows; ++y) leave_out(free.row(y), distance.cols, mask.row(y).data());
    return mask;
}

Vector find_dividers(const DepthView& distance, const ImageView& mask, const Divisions& divisions) {
    const auto& [near, far, levels] = divisions.levels;
    const Vector density =
        depth_density(depth_histogram(distance, mask, divisions.levels), divisions.bandwidth);
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

DepthObjects segment_depth(const DepthView& depth, const ImageView& free, VectorRef camera, VectorRef plane,
                           const Region& measured, const Divisions& divisions, const Cut& cut,
                           const Standing& standing) {
    const auto& [near, far, levels] = divisions.levels;
    Floats along;
    DepthView distance = depth;
    if (plane.size() > 2 && (plane.head(3) != 0.0).any()) {
        along = ground_distance(depth, camera, plane.head(3), near, far);
        distance = {along.data(), depth.rows, depth.cols, depth.cols};
    }
    const Labels mask = find_mask(distance, free, divisions);
    const ImageView under{mask.data(), depth.rows, depth.cols, 1, depth.cols};
    const Labels labels = divide_depth(distance, under, find_dividers(distance, under, divisions));
    auto found = depth_components({labels.data(), depth.rows, depth.cols, 1, depth.cols}, depth,
                                  {near, far, 0, kBins}, divisions.min_area, false);
    Flags sides = cut_sides(depth, found.table, camera, cut);
    cut_at_edge(found.table, measured, cut.border, sides);
    States states = measure_objects({found.table, found.columns, found.rows, sides}, camera,
                                    {plane, standing.feet, standing.legs});
    return {std::move(states), std::move(sides), std::move(found.columns), std::move(found.rows)};
}

}  // namespace tricue
