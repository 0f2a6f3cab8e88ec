// SPDX-License-Identifier: MIT
#include "cues/depth/support_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/read_grid.hpp"
#include "cues/depth/floor_plane.hpp"

namespace tricue {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
constexpr double kMaxDepth = 2.0;      // of the target's depth
constexpr double kTargetShare = 1.05;  // of the box's sides
constexpr double kInnerShare = 0.8;    // of the box's sides
constexpr double kMaxPlaneShare = 0.5, kMinSupportShare = 0.15;
constexpr int kMinVotes = 60;
constexpr int kThinning = 2;

/// A range of rows or columns.
struct Range {
    int begin, end;
};

/// The squares of an axis within a share of a box's side around the middle.
Range middle_part(int count, double length, double share) {
    const double half = std::max(share * length / 2, 1.0);
    Range range{count, 0};
    for (int i = 0; i < count; ++i) {
        if (!(std::abs(i + 0.5 - count / 2.0) < half)) continue;
        range.begin = std::min(range.begin, i);
        range.end = i + 1;
    }
    return range;
}

struct Part {
    Range rows, columns;

    Part(const SampleGrid& grid, const SupportedTarget& target, double share)
        : rows(middle_part(grid.rows, target.height, share)),
          columns(middle_part(grid.columns, target.width, share)) {}
};

/// Every second row and column of the depths, without the target.
Floats thin_surround(const Floats& depths, const Part& target) {
    Floats thin((depths.rows() + kThinning - 1) / kThinning, (depths.cols() + kThinning - 1) / kThinning);
    for (Eigen::Index i = 0; i < thin.rows(); ++i) {
        const float* row = depths.data() + kThinning * i * depths.cols();
        float* to = thin.data() + i * thin.cols();
        for (Eigen::Index j = 0; j < thin.cols(); ++j) to[j] = row[kThinning * j];
        if (kThinning * i < target.rows.begin || kThinning * i >= target.rows.end) continue;
        const int first = (target.columns.begin + kThinning - 1) / kThinning,
                  end = (target.columns.end + kThinning - 1) / kThinning;
        std::fill(to + first, to + std::max(first, end), kNothing);
    }
    return thin;
}

std::vector<std::int64_t> find_votes(const Floats& thin) {
    std::vector<std::int64_t> votes;
    votes.reserve(static_cast<std::size_t>(thin.size()));
    for (Eigen::Index i = 0; i < thin.size(); ++i)
        if (has_depth(thin.data()[i])) votes.push_back(i);
    return votes;
}

/// Marks the depths of a row that are on the plane; `offset` is that of the row.
TRICUE_MULTIVERSION
void mark_row(const float* __restrict depths, const double* __restrict across, int n, double offset,
              double nz, double d, double tolerance, std::uint8_t* __restrict on_plane) {
    for (int j = 0; j < n; ++j) {
        const double height = ((across[j] + offset) + nz) * static_cast<double>(depths[j]) + d;
        on_plane[j] = std::abs(height) < tolerance;
    }
}

Labels mark_plane(const Floats& depths, const Vector& lens, const Vector& plane, double tolerance) {
    const auto rows = static_cast<int>(depths.rows()), columns = static_cast<int>(depths.cols());
    std::vector<double> across(static_cast<std::size_t>(columns));
    for (int j = 0; j < columns; ++j)
        across[static_cast<std::size_t>(j)] = plane[0] * ((j - lens[2]) / lens[0]);
    Labels on_plane(rows, columns);
    for (int i = 0; i < rows; ++i)
        mark_row(depths.row(i).data(), across.data(), columns, plane[1] * ((i - lens[3]) / lens[1]), plane[2],
                 plane[3], tolerance, on_plane.row(i).data());
    return on_plane;
}

/// Whether more than half of the measured pixels in a part are on the plane.
bool is_mostly_on_plane(const Floats& depths, const Labels& on_plane, const Part& part) {
    int measured = 0, within = 0;
    for (int i = part.rows.begin; i < part.rows.end; ++i)
        for (int j = part.columns.begin; j < part.columns.end; ++j) {
            const bool known = has_depth(depths(i, j));
            measured += known;
            within += known && on_plane(i, j);
        }
    return within > kMaxPlaneShare * measured;
}

void require_arguments(const SupportedTarget& target, StatesRef draws, double tolerance) {
    require_positive(target.width, "width");
    require_positive(target.height, "height");
    require_positive(target.z, "z");
    require_positive(tolerance, "tolerance");
    require_shape(draws, draws.rows(), 3, "draws");
    for (Eigen::Index i = 0; i < draws.size(); ++i)
        if (!(draws.data()[i] >= 0.0 && draws.data()[i] < 1.0))
            refuse("draws", "numbers in [0, 1)", draws.data()[i]);
}

}  // namespace

Labels support_pixels(const DepthView& depth, const SampleGrid& grid, const SupportedTarget& target,
                      VectorRef camera, StatesRef draws, double tolerance) {
    require_grid(grid);
    require_arguments(target, draws, tolerance);
    require_camera(camera);
    Labels nowhere = Labels::Zero(grid.rows, grid.columns);
    Floats depths = read_grid(depth, grid);
    const auto most = static_cast<float>(kMaxDepth * target.z);
    depths = (depths < most && depths > 0.0F).select(depths, kNothing);
    const Floats thin = thin_surround(depths, Part(grid, target, kTargetShare));
    const std::vector<std::int64_t> votes = find_votes(thin);
    if (votes.size() < kMinVotes) return nowhere;
    const auto count = static_cast<double>(votes.size());
    const Triples triples = draws.unaryExpr([&](double draw) {
        return votes[std::min(static_cast<std::size_t>(draw * count), votes.size() - 1)];
    });
    Vector lens(4), up(3);
    lens << camera[0] / grid.step, camera[1] / grid.step, (camera[2] - grid.x0) / grid.step,
        (camera[3] - grid.y0) / grid.step;
    up << 0.0, -1.0, 0.0;
    const Vector thin_lens = lens / kThinning;
    const DepthView surround{thin.data(), static_cast<int>(thin.rows()), static_cast<int>(thin.cols()),
                             thin.cols()};
    const Vector plane = floor_plane(surround, thin_lens, triples, tolerance, {up, -1.0});
    if (plane[4] < kMinSupportShare) return nowhere;
    Labels on_plane = mark_plane(depths, lens, plane, tolerance);
    return is_mostly_on_plane(depths, on_plane, Part(grid, target, kInnerShare)) ? nowhere : on_plane;
}

}  // namespace tricue
