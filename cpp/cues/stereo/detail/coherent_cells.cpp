// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/coherent_cells.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr int kMaxSide = 127;
constexpr Eigen::Index kRegister = 32;  ///< numbers of 16 bits in the longest register

/// 1 for a cell at the expected disparity, -1 for one beside it, 0 for one without a disparity.
TRICUE_MULTIVERSION
void vote(const float* __restrict disparities, Eigen::Index n, float expected, float tolerance,
          std::int16_t* __restrict votes) {
    for_overlapping_blocks<32>(n, [=](std::ptrdiff_t j) {
        const float off = std::abs(disparities[j] - expected);
        votes[j] =
            static_cast<std::int16_t>(static_cast<int>(off <= tolerance) - static_cast<int>(off > tolerance));
    });
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

/// kSide is the side of the square; 0 stands for any side.
template <int kSide>
TRICUE_INLINE void decide_by(const std::int16_t* __restrict columns, const std::int16_t* __restrict votes,
                             Eigen::Index n, int any_side, std::uint8_t* __restrict mask) {
    const int side = kSide > 0 ? kSide : any_side;
    for_overlapping_blocks<32>(n, [=](std::ptrdiff_t j) {
        std::int16_t sum = columns[j];
        for (int k = 1; k < side; ++k) sum = static_cast<std::int16_t>(sum + columns[j + k]);
        mask[j] = static_cast<std::uint8_t>((votes[j] > 0) | ((votes[j] == 0) & (sum > 0)));
    });
}

/// A row of the mask; `columns` has half a square's zeros before and after its n sums.
TRICUE_MULTIVERSION
void decide(const std::int16_t* columns, const std::int16_t* votes, Eigen::Index n, int side,
            std::uint8_t* mask) {
    side == 7 ? decide_by<7>(columns, votes, n, side, mask) : decide_by<0>(columns, votes, n, side, mask);
}

}  // namespace

CellMask coherent_cells(FloatsRef disparities, float expected, float tolerance, int fill) {
    if (!std::isfinite(expected)) refuse("expected", "a finite number", expected);
    if (!(tolerance >= 0.0F)) refuse("tolerance", "0 or more", tolerance);
    if (fill < 1 || fill > kMaxSide || fill % 2 == 0) refuse("fill", "an odd number from 1 to 127", fill);
    const Eigen::Index rows = disparities.rows(), cols = disparities.cols(), half = fill / 2;
    // Rows of whole registers, because a remainder would be added one by one; the padding has no votes.
    const Eigen::Index width = (cols + kRegister - 1) / kRegister * kRegister;
    std::vector<std::int16_t> votes(static_cast<std::size_t>(rows * width), 0);
    const auto row = [&](Eigen::Index i) { return votes.data() + i * width; };
    for (Eigen::Index i = 0; i < rows; ++i)
        vote(disparities.data() + i * disparities.outerStride(), cols, expected, tolerance, row(i));

    CellMask mask(rows, cols);
    std::vector<std::int16_t> columns(static_cast<std::size_t>(width + 2 * half), 0);
    for (Eigen::Index y = 0; y < std::min(half, rows); ++y)
        slide_down(row(y), nullptr, width, columns.data() + half);
    for (Eigen::Index i = 0; i < rows; ++i) {
        slide_down(i + half < rows ? row(i + half) : nullptr, i > half ? row(i - half - 1) : nullptr, width,
                   columns.data() + half);
        decide(columns.data(), row(i), cols, fill, mask.data() + i * cols);
    }
    return mask;
}

}  // namespace tricue
