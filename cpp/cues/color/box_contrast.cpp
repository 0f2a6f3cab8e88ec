// SPDX-License-Identifier: MIT
#include "cues/color/box_contrast.hpp"

#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "cues/color/detail/integral_image.hpp"

namespace tricue {
namespace {

/// The center of the i-th of `count` boxes along an axis.
double center(int i, int count) {
    return count + 2.0 * (i - count / 2);
}

/// Sums of a plane over boxes of one size.
class BoxSums {
public:
    BoxSums(IntegralImage& sums, int cols, double width, double height)
        : sums_(sums), height_(height), row_(cols) {
        spans_.reserve(static_cast<std::size_t>(cols));
        for (int j = 0; j < cols; ++j)
            spans_.push_back(sums.column_span(center(j, cols) - width / 2, center(j, cols) + width / 2));
    }

    /// The sums of a row of boxes with their centers at `y`.
    const Eigen::ArrayXd& row(double y) {
        sums_.select_rows(y - height_ / 2, y + height_ / 2);
        double* sum = row_.data();
        for (const ColumnSpan& span : spans_) *sum++ = sums_.sum(span);
        return row_;
    }

private:
    IntegralImage& sums_;
    double height_;
    std::vector<ColumnSpan> spans_;
    Eigen::ArrayXd row_;
};

void require_arguments(const PlaneView& plane, const SurroundedBox& box, double surround_weight) {
    if (plane.rows < 2 || plane.cols < 2 || plane.rows % 2 != 0 || plane.cols % 2 != 0)
        refuse("plane", "even sides of at least 2", shape_text(plane.rows, plane.cols));
    require_positive(box.width, "width");
    require_positive(box.height, "height");
    if (!(box.surround_size > 1.0 && std::isfinite(box.surround_size)))
        refuse("surround_size", "a finite number above 1", box.surround_size);
    if (!std::isfinite(surround_weight)) refuse("surround_weight", "a finite number", surround_weight);
}

}  // namespace

Floats box_contrast(const PlaneView& plane, const SurroundedBox& box, double surround_weight) {
    require_arguments(plane, box, surround_weight);
    IntegralImage sums(plane);
    const int rows = plane.rows / 2, cols = plane.cols / 2;
    BoxSums inner(sums, cols, box.width, box.height),
        whole(sums, cols, box.width * box.surround_size, box.height * box.surround_size);
    const double area = box.width * box.height, surround = area * (box.surround_size * box.surround_size - 1);
    const double in_box = 1 / area + surround_weight / surround, in_whole = surround_weight / surround;
    Floats contrast(rows, cols);
    for (int i = 0; i < rows; ++i) {
        const double y = center(i, rows);
        contrast.row(i) = (in_box * inner.row(y) - in_whole * whole.row(y)).cast<float>();
    }
    return contrast;
}

}  // namespace tricue
