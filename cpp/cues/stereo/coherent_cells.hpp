// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/arrays.hpp"

namespace tricue {

/// 1 or 0 for each cell, (H, W).
using CellMask = Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The cells at an expected disparity: those whose disparity differs from it by at most the tolerance.
///
/// A cell without a disparity, as in hair of one color, gets the majority of the cells around it that have one.
///
/// @param disparities float32 (H, W), NaN where there is none
/// @param expected in the disparities' unit
/// @param tolerance 0 or more
/// @param window side of the square around a cell whose majority counts, odd, 1 to 127
/// @returns uint8 (H, W), 1 at the expected disparity, else 0; a tie gives 0
/// @throws std::invalid_argument on values out of range
/// Source: ours, for Moreno et al. 2002, section 3.2, whose pixels of coherent depth are not defined.
CellMask coherent_cells(FloatsRef disparities, float expected, float tolerance, int window);

}  // namespace tricue
