// SPDX-License-Identifier: MIT
#include "cues/depth/detail/depth_reader.hpp"

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/relative_histogram.hpp"

namespace tricue {
namespace {

/// Columns and rows of a rectangle's places; those outside the image have row -1.
TRICUE_MULTIVERSION
void find_pixels(const double* __restrict u, const double* __restrict v, std::ptrdiff_t n,
                 const double* rectangle, int cols, int rows, std::int32_t* __restrict column,
                 std::int32_t* __restrict row) {
    const double center_x = rectangle[0], center_y = rectangle[1];
    const double half_width = 0.5 * rectangle[2], half_height = 0.5 * rectangle[3];
    for (std::ptrdiff_t k = 0; k < n; ++k) {
        const double x = center_x + half_width * u[k], y = center_y + half_height * v[k];
        const bool inside = (x >= 0.0) & (x < cols) & (y >= 0.0) & (y < rows);
        column[k] = static_cast<std::int32_t>(inside ? x : 0.0);
        row[k] = static_cast<std::int32_t>(inside ? y : -1.0);
    }
}

}  // namespace

DepthReader::DepthReader(const DepthView& depth, StatesRef pattern) : depth_(depth) {
    require_shape(pattern, pattern.rows(), 2, "pattern");
    if (pattern.rows() < 1) refuse("pattern", "at least one place", "none");
    require_finite(pattern, "pattern");
    u_ = pattern.col(0);
    v_ = pattern.col(1);
    const auto places = static_cast<std::size_t>(pattern.rows());
    column_.resize(places);
    row_.resize(places);
    depths_.resize(RelativeHistogram::padded(places));
}

const float* DepthReader::read(const double* rectangle) {
    find_pixels(u_.data(), v_.data(), u_.size(), rectangle, depth_.cols, depth_.rows, column_.data(),
                row_.data());
    for (std::size_t k = 0; k < row_.size(); ++k)
        depths_[k] = row_[k] < 0 ? 0.0f : depth_.row(row_[k])[column_[k]];
    return depths_.data();
}

}  // namespace tricue
