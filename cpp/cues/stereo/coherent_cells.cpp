// SPDX-License-Identifier: MIT
#include "cues/stereo/coherent_cells.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kMaxSide = 127;

/// 1 for a cell at the expected disparity, -1 for one beside it, 0 for one without a disparity.
TRICUE_MULTIVERSION
void vote(const float* __restrict disparities, Eigen::Index n, float expected, float tolerance,
          std::int16_t* __restrict votes) {
    for (Eigen::Index j = 0; j < n; ++j) {
        const float off = std::abs(disparities[j] - expected);
        votes[j] =
            static_cast<std::int16_t>(static_cast<int>(off <= tolerance) - static_cast<int>(off > tolerance));
    }
}

/// The sums of the columns in the window of the next row: one row more and one less, nullptr for none.
TRICUE_MULTIVERSION
void slide_down(const std::int16_t* __restrict more, const std::int16_t* __restrict less, Eigen::Index n,
                std::int16_t* __restrict columns) {
    if (more)
        for (Eigen::Index j = 0; j < n; ++j) columns[j] = static_cast<std::int16_t>(columns[j] + more[j]);
    if (less)
        for (Eigen::Index j = 0; j < n; ++j) columns[j] = static_cast<std::int16_t>(columns[j] - less[j]);
}

/// A row of the mask; `columns` has `half` zeros before and after its n sums, `sums` has room for n.
TRICUE_MULTIVERSION
void decide(const std::int16_t* __restrict columns, const std::int16_t* __restrict votes, Eigen::Index n,
            int window, std::int16_t* __restrict sums, std::uint8_t* __restrict mask) {
    for (Eigen::Index j = 0; j < n; ++j) sums[j] = columns[j];
    for (int k = 1; k < window; ++k)
        for (Eigen::Index j = 0; j < n; ++j) sums[j] = static_cast<std::int16_t>(sums[j] + columns[j + k]);
    for (Eigen::Index j = 0; j < n; ++j)
        mask[j] = static_cast<std::uint8_t>((votes[j] > 0) | ((votes[j] == 0) & (sums[j] > 0)));
}

}  // namespace

CellMask coherent_cells(FloatsRef disparities, float expected, float tolerance, int window) {
    if (!std::isfinite(expected)) refuse("expected", "a finite number", expected);
    if (!(tolerance >= 0.0F)) refuse("tolerance", "0 or more", tolerance);
    if (window < 1 || window > kMaxSide || window % 2 == 0)
        refuse("window", "an odd number from 1 to 127", window);
    const Eigen::Index rows = disparities.rows(), cols = disparities.cols(), half = window / 2;
    Eigen::Array<std::int16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> votes(rows, cols);
    const auto row = [&](Eigen::Index i) { return votes.data() + i * cols; };
    for (Eigen::Index i = 0; i < rows; ++i)
        vote(disparities.data() + i * disparities.outerStride(), cols, expected, tolerance, row(i));

    CellMask mask(rows, cols);
    std::vector<std::int16_t> columns(static_cast<std::size_t>(cols + 2 * half), 0), sums(columns);
    for (Eigen::Index y = 0; y < std::min(half, rows); ++y)
        slide_down(row(y), nullptr, cols, columns.data() + half);
    for (Eigen::Index i = 0; i < rows; ++i) {
        slide_down(i + half < rows ? row(i + half) : nullptr, i > half ? row(i - half - 1) : nullptr, cols,
                   columns.data() + half);
        decide(columns.data(), row(i), cols, window, sums.data(), mask.data() + i * cols);
    }
    return mask;
}

}  // namespace tricue
