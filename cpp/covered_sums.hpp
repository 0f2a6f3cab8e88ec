// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "camera/plane_view.hpp"

namespace tricue {

/// Sums of a plane over boxes between any two numbers, pixels counting by the part that is covered and 0 lying outside: by running
/// sums in float64, so a box costs the same whatever its size.
class CoveredSums {
public:
    /// @throws std::invalid_argument where the plane has a number that isn't finite
    explicit CoveredSums(const PlaneView& plane);

    /// The rows between `low` and `high` to add up in the boxes that follow.
    void take_rows(double low, double high);
    /// Of these rows, the columns between `low` and `high`.
    double columns(double low, double high) const { return upto(high) - upto(low); }

private:
    int rows_, cols_;
    std::vector<double> down_;    ///< row y: the sums of the rows before it
    std::vector<double> across_;  ///< the same of the columns of the rows taken

    double upto(double x) const;
    const double* row(int y) const { return down_.data() + std::ptrdiff_t{y} * cols_; }
};

}  // namespace tricue
