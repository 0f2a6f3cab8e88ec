// SPDX-License-Identifier: MIT
#include "fuse/detail/correlation_checks.hpp"

#include <string>

#include "base/check.hpp"

namespace tricue {
namespace {

std::string shape_text(int planes, int rows, int cols) {
    return "(" + std::to_string(planes) + ", " + std::to_string(rows) + ", " + std::to_string(cols) + ")";
}

std::string shape(const FilterStack& filters) {
    return "(" + std::to_string(filters.filters) + ", " + std::to_string(filters.planes) + ", " +
           std::to_string(filters.rows) + ", " + std::to_string(filters.cols) + ")";
}

}  // namespace

void require_cells(const FloatStack& cells) {
    if (cells.planes < 1 || cells.rows < 1 || cells.cols < 1)
        refuse("cells", "at least one channel and cell", shape_text(cells.planes, cells.rows, cells.cols));
}

void require_filters(const FilterStack& filters, const FloatStack& cells) {
    const FilterStack expected{nullptr, filters.filters, cells.planes, cells.rows, cells.cols / 2 + 1};
    if (filters.filters < 1) refuse("filters", "at least one filter", shape(filters));
    if (filters.planes != expected.planes || filters.rows != expected.rows || filters.cols != expected.cols)
        refuse("filters", "shape " + shape(expected), shape(filters));
}

void require_filter(const char* name, const ComplexStack& filter, const FloatStack& cells) {
    const int half = cells.cols / 2 + 1;
    if (filter.planes != cells.planes || filter.rows != cells.rows || filter.cols != half)
        refuse(name, "shape " + shape_text(cells.planes, cells.rows, half),
               shape_text(filter.planes, filter.rows, filter.cols));
}

void require_denominator(FloatsRef denominator, const FloatStack& cells) {
    require_shape(denominator.rows(), denominator.cols(), cells.rows, cells.cols / 2 + 1, "denominator");
}

void require_rate(double rate) {
    if (!(rate >= 0.0 && rate <= 1.0)) refuse("rate", "a number in [0, 1]", rate);
}

}  // namespace tricue
