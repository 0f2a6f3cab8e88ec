// SPDX-License-Identifier: MIT
#include "cues/color/box_means.hpp"

#include <cmath>

#include "base/check.hpp"
#include "cues/color/detail/integral_image.hpp"

namespace tricue {
namespace {

void require_finite(double place, const char* name) {
    if (!std::isfinite(place)) refuse(name, "a finite number", place);
}

void require_lengths(VectorRef lengths, const char* name) {
    tricue::require_finite(lengths, name);
    for (const double length : lengths)
        if (!(length > 0.0)) refuse(name, "numbers above 0", length);
}

}  // namespace

Vector box_means(const PlaneView& plane, double x, double y, VectorRef widths, VectorRef heights) {
    if (plane.rows < 1 || plane.cols < 1) refuse("plane", "at least one pixel", "none");
    require_finite(x, "x");
    require_finite(y, "y");
    require_lengths(widths, "widths");
    require_size(heights, widths.size(), "heights");
    require_lengths(heights, "heights");
    IntegralImage sums(plane);
    Vector means(widths.size());
    for (Eigen::Index i = 0; i < widths.size(); ++i) {
        const double width = widths[i], height = heights[i];
        sums.select_rows(y - height / 2, y + height / 2);
        means[i] = sums.sum(sums.column_span(x - width / 2, x + width / 2)) / (width * height);
    }
    return means;
}

}  // namespace tricue
