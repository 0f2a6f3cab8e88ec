// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "cues/motion/detail/flow_constraints.hpp"
#include "cues/motion/detail/gaussian_rows.hpp"

namespace tricue {

/// The mean over a window of the products of which the normal equations of two constraints a pixel consist: A^T A of
/// xx, xy, yy, A^T b of xt, yt.
struct Products {
    float *xx, *xy, *yy, *xt, *yt;
};

/// Pools constraints, row by row from above, over 2 pool + 1 pixels square.
class PooledRows {
public:
    /// @param length pixels of a pooled row
    PooledRows(int pool, int length);

    /// Takes row y, y from -pool on, of length + 2 pool pixels, beginning pool left of the pooled ones.
    void push(int y, const Constraints& constraints);

    /// Row y, where rows y - pool to y + pool were the last pushed; until the next call.
    Products row(int y);

private:
    int pool_, length_;
    std::array<RowRing, 5> products_;
    RowRing sums_, result_;
};

}  // namespace tricue
