// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "cues/motion/detail/flow_constraints.hpp"
#include "cues/motion/detail/gaussian_rows.hpp"

namespace tricue {

/// The normal equations of two constraints per pixel, averaged over a window: A^T A is (xx, xy; xy, yy), A^T b is (xt, yt).
struct NormalEquations {
    float *xx, *xy, *yy, *xt, *yt;
};

/// Averages the normal equations, row by row from above, over squares of 2 pool + 1 pixels.
class NormalEquationRows {
public:
    /// @param length pixels of an averaged row
    NormalEquationRows(int pool, int length);

    /// Takes row y, y from -pool on, of length + 2 pool pixels, beginning pool left of the averaged ones.
    void push(int y, const Constraints& constraints);

    /// Row y, where rows y - pool to y + pool were the last pushed; until the next call.
    NormalEquations row(int y);

private:
    int pool_, length_;
    std::array<RowRingBuffer, 5> products_;
    RowRingBuffer sums_, result_;
};

}  // namespace tricue
