// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>

namespace tricue {

/// Planes of floats with a border of one number, so that every number inside has all its neighbors. Initial values are
/// unspecified.
class PaddedPlanes {
public:
    PaddedPlanes(int planes, int rows, int cols)
        : rows_(rows),
          cols_(cols),
          numbers_(new float[static_cast<std::size_t>(planes) * (static_cast<std::size_t>(rows) + 2) *
                             (static_cast<std::size_t>(cols) + 2)]) {}

    /// The first number of row y inside the border; y is -1 to `rows`.
    float* row(int plane, int y) {
        const std::ptrdiff_t line = plane * (std::ptrdiff_t{rows_} + 2) + y + 1;
        return numbers_.get() + line * (std::ptrdiff_t{cols_} + 2) + 1;
    }

    /// Sets the border to the nearest numbers inside; the plane must not be empty.
    void replicate_border(int plane) {
        for (int y = 0; y < rows_; ++y) {
            float* inside = row(plane, y);
            inside[-1] = inside[0];
            inside[cols_] = inside[cols_ - 1];
        }
        std::copy_n(row(plane, 0) - 1, cols_ + 2, row(plane, -1) - 1);
        std::copy_n(row(plane, rows_ - 1) - 1, cols_ + 2, row(plane, rows_) - 1);
    }

private:
    int rows_, cols_;
    std::unique_ptr<float[]> numbers_;
};

}  // namespace tricue
