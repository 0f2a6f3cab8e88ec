// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "base/arrays.hpp"
#include "cues/depth/cut_sides.hpp"

namespace tricue {

/// The features of C objects, as segment_depth gives them.
struct ObjectFeatures {
    StatesRef measured;
    Eigen::Ref<const Flags> cut;
    FloatsRef columns, rows;
};

/// A rectangle in meters: X, Y, Z of its center, width and height.
using RectangleState = std::array<double, 5>;

/// An object's rectangle.
RectangleState rectangle_of(const ObjectFeatures& objects, Eigen::Index index);

/// A rectangle as if nothing cut it: extended to the size (2,) beyond its cut sides (4). If opposite sides are cut, it is as near
/// to the expected center as its visible part allows.
RectangleState complete_rectangle(const RectangleState& state, const bool* cut, VectorRef expected,
                                  VectorRef size);

/// Arguments of kernels that compare objects with a target.
void require_objects(const ObjectFeatures& objects);
void require_size_above_0(VectorRef size);

}  // namespace tricue
