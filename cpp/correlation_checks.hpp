// SPDX-License-Identifier: MIT
#pragma once

#include "camera/arrays.hpp"
#include "camera/stack_view.hpp"

namespace tricue {

/// Each throws std::invalid_argument that names the argument, what was expected and what came.
void require_cells(const FloatStack& cells);
/// Of the spectra (planes, rows, cols / 2 + 1) of such cells.
void require_numerator(const ComplexStack& numerator, const FloatStack& cells);
void require_plane(const char* name, Eigen::Index rows, Eigen::Index cols, int expected_rows,
                   int expected_cols);
/// One plane of such spectra.
void require_denominator(FloatsRef denominator, const FloatStack& cells);
/// Of S scales with D channels: both at least 1, the numerator of S x D, the denominator of S.
void require_looks(FloatsRef looks, ComplexesRef numerator, FloatsRef denominator);
void require_scales(const char* name, Eigen::Index scales, Eigen::Index expected);
void require_rate(double rate);
void require_ridge(double ridge);

}  // namespace tricue
