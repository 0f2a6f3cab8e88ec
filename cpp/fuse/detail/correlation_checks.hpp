// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// Each throws std::invalid_argument that names the argument, what was expected and what was given.
void require_cells(const FloatStack& cells);
/// At least one filter for such cells: (filters, planes, rows, cols / 2 + 1).
void require_filters(const FilterStack& filters, const FloatStack& cells);
/// One filter for such cells.
void require_filter(const char* name, const ComplexStack& filter, const FloatStack& cells);
/// One plane of such spectra.
void require_denominator(FloatsRef denominator, const FloatStack& cells);
void require_rate(double rate);

}  // namespace tricue
