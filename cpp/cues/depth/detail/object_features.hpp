// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "base/arrays.hpp"
#include "cues/depth/cut_sides.hpp"

namespace tricue {

/// The features of C objects, as segment_depth gives them.
struct ObjectFeatures {
    StatesRef measured;           ///< float64 (C, 8), as measure_objects gives it, finite
    Eigen::Ref<const Flags> cut;  ///< bool (C, 4): whether each may continue at the left, right, top, bottom
    FloatsRef columns, rows;      ///< float32 (C, bins), as depth_components gives them
};

/// The body that is expected among objects.
struct ExpectedBody {
    VectorRef state;  ///< float64 (5,): X, Y, Z, W, H, meters, finite
    VectorRef size;   ///< float64 (2,): running means of its width and height, meters, finite, above 0
    /// bool (2,): whether each was ever visible as a whole; else it is a lower bound
    std::array<bool, 2> known;
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
void require_expected(const ExpectedBody& expected);

}  // namespace tricue
