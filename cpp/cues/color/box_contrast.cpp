// SPDX-License-Identifier: MIT
#include "cues/color/box_contrast.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "check.hpp"
#include "covered_sums.hpp"

namespace tricue {
namespace {

/// Sums over boxes of one size at all places.
States box_sums(CoveredSums& sums, int rows, int cols, double width, double height) {
    States found(rows, cols);
    std::vector<CoveredSpan> across;
    across.reserve(static_cast<std::size_t>(cols));
    for (int j = 0; j < cols; ++j) {
        const double x = cols + 2.0 * (j - cols / 2);
        across.push_back(sums.across(x - width / 2, x + width / 2));
    }
    for (int i = 0; i < rows; ++i) {
        const double y = rows + 2.0 * (i - rows / 2);
        sums.take_rows(y - height / 2, y + height / 2);
        double* row = &found(i, 0);
        for (const CoveredSpan& span : across) *row++ = sums.columns(span);
    }
    return found;
}

void require_arguments(const PlaneView& plane, const FramedBox& box, double around) {
    if (plane.rows < 2 || plane.cols < 2 || plane.rows % 2 != 0 || plane.cols % 2 != 0)
        refuse("plane", "even sides of at least 2",
               "(" + std::to_string(plane.rows) + ", " + std::to_string(plane.cols) + ")");
    if (!(box.width > 0.0 && std::isfinite(box.width))) refuse("width", "a finite number above 0", box.width);
    if (!(box.height > 0.0 && std::isfinite(box.height)))
        refuse("height", "a finite number above 0", box.height);
    if (!(box.outer > 1.0 && std::isfinite(box.outer))) refuse("outer", "a finite number above 1", box.outer);
    if (!std::isfinite(around)) refuse("around", "a finite number", around);
}

}  // namespace

Floats box_contrast(const PlaneView& plane, const FramedBox& box, double around) {
    require_arguments(plane, box, around);
    CoveredSums sums(plane);
    const int rows = plane.rows / 2, cols = plane.cols / 2;
    const States inner = box_sums(sums, rows, cols, box.width, box.height);
    const States whole = box_sums(sums, rows, cols, box.width * box.outer, box.height * box.outer);
    const double area = box.width * box.height, frame = area * (box.outer * box.outer - 1);
    return (inner / area - around * ((whole - inner) / frame)).cast<float>();
}

}  // namespace tricue
