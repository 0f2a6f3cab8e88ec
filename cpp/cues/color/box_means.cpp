// SPDX-License-Identifier: MIT
#include "cues/color/box_means.hpp"

#include "check.hpp"
#include "covered_sums.hpp"

namespace tricue {
namespace {

void require_lengths(VectorRef lengths, const char* name) {
    require_finite(lengths, name);
    for (const double length : lengths)
        if (!(length > 0.0)) refuse(name, "numbers above 0", length);
}

}  // namespace

Vector box_means(const PlaneView& plane, VectorRef widths, VectorRef heights) {
    if (plane.rows < 1 || plane.cols < 1) refuse("plane", "at least one pixel", "none");
    require_lengths(widths, "widths");
    require_size(heights, widths.size(), "heights");
    require_lengths(heights, "heights");
    CoveredSums sums(plane);
    Vector means(widths.size());
    for (Eigen::Index i = 0; i < widths.size(); ++i) {
        const double width = widths[i], height = heights[i];
        sums.take_rows((plane.rows - height) / 2, (plane.rows + height) / 2);
        means[i] =
            sums.columns(sums.across((plane.cols - width) / 2, (plane.cols + width) / 2)) / (width * height);
    }
    return means;
}

}  // namespace tricue
