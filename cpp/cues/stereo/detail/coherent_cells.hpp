// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/arrays.hpp"

namespace tricue {

/// 1 or 0 for each cell, (H, W).
using CellMask = Eigen::Array<std::uint8_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The cells whose disparity, NaN if missing, differs from the expected one by at most the tolerance.
///
/// A cell without a disparity gets the majority of the cells in a square around it, of `fill` cells a side, odd, 1 to 127; a tie
/// gives 0. Throws std::invalid_argument on values out of range.
CellMask coherent_cells(FloatsRef disparities, float expected, float tolerance, int fill);

}  // namespace tricue
