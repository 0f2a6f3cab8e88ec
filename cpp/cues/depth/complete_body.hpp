// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/depth/detail/object_features.hpp"

namespace tricue {

/// The conditions for an object to be a piece of a body.
struct PieceLimits {
    /// size of the region in which it lies, over that of the expected rectangle, around which it is
    double region;
    double inside;  ///< a piece has more than this share of its area in that region
    /// a joined body is at most this many times the mean size, or the size before if that is larger
    double joined;
    double depth;  ///< a piece's depth differs by less than this from the object's, meters
};

/// A body in meters.
struct Body {
    Vector state;  ///< float64 (5,): X, Y, Z, W, H, completed where it is cut
    Flags whole;   ///< bool (2,): whether the whole width and the whole height are visible
    Vector size;   ///< float64 (2,): the mean size; where it isn't known, at least that of the object
    /// float64 (2 bins + 2,): the object's columns and rows; centroid of all pieces less the center, x and y, meters
    Vector signature;
};

/// The body of which an object is a part: joined with the pieces that gaps separate from it, and completed where it is cut.
///
/// A piece, such as an arm or a leg, lies for the most part in the region around the expected rectangle, and near the object's
/// depth. Candidates are tried one after the other; each is joined if it brings the body closer to the mean size, by the sum of
/// the squared logarithms of the ratios, and the joined body is hardly larger. The joined box is that around all pieces as the
/// camera sees them, at the object's depth; it is cut where one of them is. It is extended to the mean size beyond the sides that
/// are cut; between two opposite ones it is as near to the expected center as its visible part allows.
///
/// @param index of the object, in [0, C)
/// @throws std::invalid_argument on other shapes or values, NaN limits, or depths, sizes or areas that aren't above 0
/// Source: ours.
Body complete_body(const ObjectFeatures& objects, int index, const ExpectedBody& expected,
                   const PieceLimits& limits);

}  // namespace tricue
