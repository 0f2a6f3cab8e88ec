// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/depth/detail/object_features.hpp"

namespace tricue {

/// Where a body is expected, and its size as far as it is known.
struct ExpectedBody {
    VectorRef state, size;
    bool width_known, height_known;
};

/// Which objects are pieces of a body.
struct PieceLimits {
    double region, inside, joined, depth;
};

/// A body in meters.
struct Body {
    Vector state;  ///< float64 (5,): X, Y, Z, W, H, completed where it is cut
    Flags whole;   ///< bool (2,): whether the whole width and the whole height are visible
    Vector size;   ///< float64 (2,): the mean size; where it isn't known, at least that of the object
    Vector
        signature;  ///< float64 (2 bins + 2,): the object's columns and rows; centroid of all pieces less the center, x and y, meters
};

/// The body of which an object is a part: joined with the pieces that gaps separate from it, and completed where it is cut.
///
/// A piece, such as an arm or a leg, lies for the most part in the region around the expected rectangle, and near the object's depth.
/// One after the other is joined where the body, then, is more nearly of the mean size, by the sum of the squared logarithms of the
/// ratios, and hardly larger. The joined box is that around all pieces as the camera sees them, at the object's depth; it is cut where
/// one of them is. What is cut is extended to the mean size beyond the sides that are cut; between two of these it is as near to the
/// expected center as its visible part allows.
///
/// @param measured float64 (C, 8), as measure_objects gives it, finite, depths, sizes and areas above 0
/// @param cut bool (C, 4): whether it may go on at the left, right, top, bottom
/// @param columns float32 (C, bins), as depth_components gives them
/// @param rows as columns
/// @param index of the object, in [0, C)
/// @param expected float64 (5,): X, Y, Z, W, H, meters, finite
/// @param mean_size (size, known): float64 (2,), running means of the body's width and height, meters, finite, above 0; bool (2,):
///     whether each was ever visible as a whole; else it is a lower bound
/// @param pieces (region, inside, joined, depth): times the expected rectangle, around it; share of a piece's area that is more than
///     inside; times the mean size, of a body with its pieces; meters, from the object's depth to that of a piece; none NaN
/// @throws std::invalid_argument on other shapes or values
/// Source: ours.
Body complete_body(const ObjectFeatures& objects, int index, const ExpectedBody& expected,
                   const PieceLimits& limits);

}  // namespace tricue
