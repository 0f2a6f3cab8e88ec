// SPDX-License-Identifier: MIT
#include "depth_reader.hpp"

#include <algorithm>
#include <cmath>

#include "check.hpp"
#include "depth_pixels.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

/// Columns and rows of a rectangle's places; those outside the image have row -1.
TRICUE_MULTIVERSION
void place(const double* __restrict u, const double* __restrict v, std::ptrdiff_t n, const double* rectangle,
           int cols, int rows, std::int32_t* __restrict column, std::int32_t* __restrict row) {
    const double center_x = rectangle[0], center_y = rectangle[1];
    const double half_width = 0.5 * rectangle[2], half_height = 0.5 * rectangle[3];
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const double x = center_x + half_width * u[k], y = center_y + half_height * v[k];
        const bool inside = (x >= 0.0) & (x < cols) & (y >= 0.0) & (y < rows);
        column[k] = static_cast<std::int32_t>(inside ? x : 0.0);
        row[k] = static_cast<std::int32_t>(inside ? y : -1.0);
    }
}

/// Levels of depths relative to z, `levels` of what doesn't count. Returns how many are below `limit`.
TRICUE_MULTIVERSION
int find_levels(const float* __restrict depth, std::ptrdiff_t n, double z, double reach, double levels,
                double limit, std::int32_t* __restrict level) {
    const double scale = levels / (2.0 * reach);
    int nearer = 0;
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const bool measured = has_depth(depth[k]);
        const double metres = static_cast<double>(depth[k]);
        const double at = ((metres - z) + reach) * scale;
        const bool counts = measured & (at >= 0.0) & (at < levels);
        level[k] = static_cast<std::int32_t>(counts ? at : levels);
        nearer += measured & (metres < limit);
    }
    return nearer;
}

}  // namespace

DepthReader::DepthReader(const DepthView& depth, StatesRef pattern, Eigen::Index levels, double reach,
                         double nearer)
    : depth_(depth), reach_(reach), nearer_(nearer) {
    require_shape(pattern, pattern.rows(), 2, "pattern");
    if (pattern.rows() < 1) refuse("pattern", "at least one place", "none");
    require_finite(pattern, "pattern");
    if (!(reach > 0.0 && std::isfinite(reach))) refuse("reach", "a finite number above 0", reach);
    if (!(nearer >= 0.0 && std::isfinite(nearer))) refuse("nearer", "a finite number, not negative", nearer);

    u_ = pattern.col(0);
    v_ = pattern.col(1);
    const auto places = static_cast<std::size_t>(pattern.rows());
    column_.resize(places);
    row_.resize(places);
    level_.resize(places);
    seen_.resize(places);
    counts_.resize(static_cast<std::size_t>(levels) + 1);
}

void DepthReader::read(const double* rectangle) {
    const std::ptrdiff_t n = u_.size();
    place(u_.data(), v_.data(), n, rectangle, depth_.cols, depth_.rows, column_.data(), row_.data());
    for (std::size_t k = 0; k < seen_.size(); ++k)
        seen_[k] = row_[k] < 0 ? 0.0f : depth_.row(row_[k])[column_[k]];
    const double z = rectangle[4];
    const auto levels = static_cast<double>(counts_.size() - 1);
    before_ = find_levels(seen_.data(), n, z, reach_, levels, z - nearer_, level_.data());
    std::fill(counts_.begin(), counts_.end(), 0);
    for (const std::int32_t level : level_) ++counts_[static_cast<std::size_t>(level)];
}

}  // namespace tricue
