// SPDX-License-Identifier: MIT
#include "cues/stereo/coherent_cells.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"

namespace tricue {
namespace {

constexpr int kMaxSide = 127;

/// 1 for a cell at the expected disparity, -1 for one beside it, 0 for one without a disparity.
std::int16_t vote(float disparity, float expected, float tolerance) {
    const float off = std::abs(disparity - expected);
    return static_cast<std::int16_t>(static_cast<int>(off <= tolerance) - static_cast<int>(off > tolerance));
}

}  // namespace

CellMask coherent_cells(FloatsRef disparities, float expected, float tolerance, int window) {
    if (!std::isfinite(expected)) refuse("expected", "a finite number", expected);
    if (!(tolerance >= 0.0F)) refuse("tolerance", "0 or more", tolerance);
    if (window < 1 || window > kMaxSide || window % 2 == 0)
        refuse("window", "an odd number from 1 to 127", window);
    const Eigen::Index rows = disparities.rows(), cols = disparities.cols(), half = window / 2;
    Eigen::Array<std::int16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> votes(rows, cols);
    for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < cols; ++j) votes(i, j) = vote(disparities(i, j), expected, tolerance);

    CellMask mask(rows, cols);
    Eigen::Array<int, 1, Eigen::Dynamic> column = Eigen::Array<int, 1, Eigen::Dynamic>::Zero(cols);
    for (Eigen::Index y = 0; y < std::min(half, rows); ++y) column += votes.row(y).cast<int>();
    for (Eigen::Index i = 0; i < rows; ++i) {
        if (i + half < rows) column += votes.row(i + half).cast<int>();
        if (i > half) column -= votes.row(i - half - 1).cast<int>();
        int sum = column.head(std::min(half, cols)).sum();
        for (Eigen::Index j = 0; j < cols; ++j) {
            if (j + half < cols) sum += column(j + half);
            if (j > half) sum -= column(j - half - 1);
            const int own = votes(i, j);
            mask(i, j) = static_cast<std::uint8_t>(own > 0 || (own == 0 && sum > 0));
        }
    }
    return mask;
}

}  // namespace tricue
