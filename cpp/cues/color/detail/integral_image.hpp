// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "base/plane_view.hpp"

namespace tricue {

/// A position along an axis in pixels: the pixel that it lies in, and how far into it, 0 to 1.
struct FractionalIndex {
    int index;
    double fraction;
};

/// A span from one position to another along a row.
struct ColumnSpan {
    FractionalIndex low, high;
};

/// Sums of a plane over boxes with fractional borders, by an integral image in float64: a box costs the same for any size. Pixels
/// count by their covered fraction; outside the plane everything is 0.
class IntegralImage {
public:
    /// @throws std::invalid_argument if the plane has a number that isn't finite
    explicit IntegralImage(const PlaneView& plane);

    /// Selects the rows of the following boxes, from `low` to `high`.
    void select_rows(double low, double high);
    /// The columns from `low` to `high`, for any rows.
    ColumnSpan column_span(double low, double high) const;
    /// The sum over these columns of the selected rows.
    double sum(const ColumnSpan& span) const { return sum_before(span.high) - sum_before(span.low); }

private:
    int rows_, cols_;
    std::vector<double> sums_;  ///< the integral image: at (y, x) the sum of all pixels above and left of it
    std::vector<double> band_;  ///< sums over the selected rows from the left edge to each column

    double sum_before(const FractionalIndex& at) const {
        const double* sums = band_.data() + at.index;
        return sums[0] + at.fraction * (sums[1] - sums[0]);
    }
    double* row(int y) { return sums_.data() + std::ptrdiff_t{y} * (cols_ + 1); }
};

}  // namespace tricue
