// SPDX-License-Identifier: MIT
#include "cues/depth/detail/object_features.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "base/check.hpp"

namespace tricue {
namespace {

constexpr Eigen::Index kNumbers = 8;  // of an object, as measure_objects gives them

/// Middle and extent of an interval, extended to `size` beyond its cut ends.
std::pair<double, double> extend(double middle, double extent, bool cut_before, bool cut_after,
                                 double expected, double size) {
    const double half = (size - extent) / 2;
    if (half <= 0.0 || !(cut_before || cut_after)) return {middle, extent};
    if (cut_before && cut_after) return {std::min(std::max(expected, middle - half), middle + half), size};
    return {cut_before ? middle - half : middle + half, size};
}

}  // namespace

RectangleState rectangle_of(const ObjectFeatures& objects, Eigen::Index index) {
    const auto each = objects.measured.row(index);
    return {each[0], each[1], each[2], each[3], each[4]};
}

RectangleState complete_rectangle(const RectangleState& state, const bool* cut, VectorRef expected,
                                  VectorRef size) {
    const auto [x, width] = extend(state[0], state[3], cut[0], cut[1], expected[0], size[0]);
    const auto [y, height] = extend(state[1], state[4], cut[2], cut[3], expected[1], size[1]);
    return {x, y, state[2], width, height};
}

void require_objects(const ObjectFeatures& objects) {
    const Eigen::Index count = objects.measured.rows();
    require_shape(objects.measured, count, kNumbers, "measured");
    require_finite(objects.measured, "measured");
    require_rows(objects.cut.rows(), count, "cut");
    require_rows(objects.columns.rows(), count, "columns");
    require_rows(objects.rows.rows(), count, "rows");
    if (objects.rows.cols() != objects.columns.cols())
        refuse("rows", std::to_string(objects.columns.cols()) + " bins", std::to_string(objects.rows.cols()));
}

void require_expected(const ExpectedBody& expected) {
    const auto& [state, size, known] = expected;
    require_size(state, 5, "state");
    require_finite(state, "state");
    require_size(size, 2, "size");
    require_finite(size, "size");
    if (!(size.minCoeff() > 0.0)) refuse("size", "numbers above 0", size.minCoeff());
}

}  // namespace tricue
