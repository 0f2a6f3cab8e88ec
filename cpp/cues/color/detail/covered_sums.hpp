// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "base/plane_view.hpp"

namespace tricue {

/// A place between rows or columns: the one that it lies in, which the last one's end belongs to, and how far.
struct CoveredPlace {
    int whole;
    double part;
};

/// From one place to another.
struct CoveredSpan {
    CoveredPlace low, high;
};

/// Sums of a plane over boxes between any two numbers, pixels counting by the part that is covered and 0 lying outside: by an
/// integral image in float64, so a box costs the same whatever its size.
class CoveredSums {
public:
    /// @throws std::invalid_argument where the plane has a number that isn't finite
    explicit CoveredSums(const PlaneView& plane);

    /// The rows between `low` and `high` to add up in the boxes that follow.
    void take_rows(double low, double high);
    /// The columns between `low` and `high`, for any rows.
    CoveredSpan across(double low, double high) const;
    /// Of the rows taken, these columns.
    double columns(const CoveredSpan& span) const { return upto(span.high) - upto(span.low); }

private:
    int rows_, cols_;
    std::vector<double> sums_;   ///< row y, column x: of all that lies above and left of the pixel
    std::vector<double> strip_;  ///< the same of the rows taken

    double upto(const CoveredPlace& at) const {
        const double* sums = strip_.data() + at.whole;
        return sums[0] + at.part * (sums[1] - sums[0]);
    }
    double* row(int y) { return sums_.data() + std::ptrdiff_t{y} * (cols_ + 1); }
};

}  // namespace tricue
