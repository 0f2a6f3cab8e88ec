// SPDX-License-Identifier: MIT
#include "cues/depth/complete_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/check.hpp"

namespace tricue {
namespace {

using Index = Eigen::Index;

/// Box, cut sides, and centroid minus the box's center, of one or several objects.
struct JoinedObjects {
    RectangleState state;
    std::array<bool, 4> cut;
    double shift_x, shift_y;
};

JoinedObjects one_object(const ObjectFeatures& objects, Index index) {
    JoinedObjects one{
        rectangle_of(objects, index), {}, objects.measured(index, 5), objects.measured(index, 6)};
    for (std::size_t side = 0; side < one.cut.size(); ++side)
        one.cut[side] = objects.cut(index, static_cast<Index>(side));
    return one;
}

/// The box around all pieces as the camera sees them, at depth z.
JoinedObjects combine(const ObjectFeatures& objects, const std::vector<Index>& pieces, double z) {
    std::array<double, 2> first, last, centroid{};
    std::array<bool, 4> cut{};
    first.fill(HUGE_VAL);
    last.fill(-HUGE_VAL);
    double area = 0.0;
    for (const Index piece : pieces) area += objects.measured(piece, 7);
    for (const Index piece : pieces) {
        const auto each = objects.measured.row(piece);
        const double scale = z / each[2], share = each[7] / area;
        for (Index axis = 0; axis < 2; ++axis) {
            const auto at = static_cast<std::size_t>(axis);
            const double center = each[axis] * scale, half = each[3 + axis] * scale / 2;
            first[at] = std::min(first[at], center - half);
            last[at] = std::max(last[at], center + half);
            centroid[at] += share * (each[axis] + each[5 + axis]);
        }
        for (std::size_t side = 0; side < cut.size(); ++side)
            cut[side] |= objects.cut(piece, static_cast<Index>(side));
    }
    const double x = (first[0] + last[0]) / 2, y = (first[1] + last[1]) / 2;
    return {{x, y, z, last[0] - first[0], last[1] - first[1]}, cut, centroid[0] - x, centroid[1] - y};
}

/// The share of a rectangle's area in the region around the expected one.
double share_inside(const RectangleState& state, VectorRef expected, double region) {
    double share = 1.0;
    for (Index axis = 0; axis < 2; ++axis) {
        const double middle = state[static_cast<std::size_t>(axis)],
                     extent = state[static_cast<std::size_t>(axis) + 3], center = expected[axis],
                     size = expected[axis + 3];
        const double low = std::max(middle - extent / 2, center - region * size / 2),
                     high = std::min(middle + extent / 2, center + region * size / 2);
        share *= std::max(high - low, 0.0) / extent;
    }
    return share;
}

/// How far a rectangle's size is from the mean size.
double misfit(const RectangleState& state, VectorRef size) {
    const double width = std::log(state[3] / size[0]), height = std::log(state[4] / size[1]);
    return width * width + height * height;
}

JoinedObjects join_pieces(const ObjectFeatures& objects, Index index, const ExpectedBody& expected,
                          const PieceLimits& limits) {
    JoinedObjects body = one_object(objects, index);
    const double z = body.state[2];
    const VectorRef& size = expected.size;
    std::vector<Index> own{index};
    for (Index i = 0; i < objects.measured.rows(); ++i) {
        const RectangleState piece = rectangle_of(objects, i);
        if (i == index || !(std::abs(piece[2] - z) < limits.depth) ||
            !(share_inside(piece, expected.state, limits.region) > limits.inside))
            continue;
        own.push_back(i);
        const JoinedObjects joined = combine(objects, own, z);
        const bool fits = joined.state[3] <= limits.joined * std::max(size[0], body.state[3]) &&
                          joined.state[4] <= limits.joined * std::max(size[1], body.state[4]);
        if (fits && misfit(joined.state, size) < misfit(body.state, size))
            body = joined;
        else
            own.pop_back();
    }
    return body;
}

void require_arguments(const ObjectFeatures& objects, int index, const ExpectedBody& expected,
                       const PieceLimits& limits) {
    require_objects(objects);
    const Index count = objects.measured.rows();
    if (index < 0 || index >= count)
        refuse("index", "a number in [0, " + std::to_string(count) + ")", std::to_string(index));
    for (Index i = 0; i < count; ++i)
        for (const Index number : {2, 3, 4, 7})
            if (!(objects.measured(i, number) > 0.0))
                refuse("measured", "depths, sizes and areas above 0", objects.measured(i, number));
    require_expected(expected);
    for (const double limit : {limits.region, limits.inside, limits.joined, limits.depth})
        if (std::isnan(limit)) refuse("limits", "numbers", limit);
}

}  // namespace

Body complete_body(const ObjectFeatures& objects, int index, const ExpectedBody& expected,
                   const PieceLimits& limits) {
    require_arguments(objects, index, expected, limits);
    const JoinedObjects found = join_pieces(objects, index, expected, limits);
    const Index bins = objects.columns.cols();
    Body body{Vector(5), Flags(2, 1), expected.size, Vector(2 * bins + 2)};
    for (Index axis = 0; axis < 2; ++axis)
        if (!expected.known[static_cast<std::size_t>(axis)])
            body.size[axis] = std::max(body.size[axis], objects.measured(index, 3 + axis));
    const RectangleState state = complete_rectangle(found.state, found.cut.data(), expected.state, body.size);
    std::copy(state.begin(), state.end(), body.state.data());
    body.whole << !(found.cut[0] || found.cut[1]), !(found.cut[2] || found.cut[3]);
    body.signature << objects.columns.row(index).transpose().cast<double>(),
        objects.rows.row(index).transpose().cast<double>(), found.shift_x, found.shift_y;
    return body;
}

}  // namespace tricue
