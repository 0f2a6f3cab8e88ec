// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/depth/detail/object_features.hpp"

namespace tricue {

/// The standard deviations of the target's object from the expected state.
struct MatchDeviation {
    double x, y, z;      ///< standard deviations of the position, meters, above 0
    double share, base;  ///< that of a size is share x size + base, meters; neither negative, and not both 0
};

/// The weights along an axis on which the size isn't known.
struct UnknownWeights {
    double center;  ///< weight of the position along an axis on which the size isn't known, finite
    double larger;  ///< weight of a size there that exceeds the mean, finite
};

/// The costs that tell the target from other objects.
struct MatchCosts {
    MatchDeviation deviation;
    UnknownWeights unknown;
    double signature_cost;  ///< of distributions that have nothing in common, nats, finite
    double max_cost;        ///< the target's cost is below this, nats
    double min_area;        ///< the target's visible part has at least this area, m²
};

/// Which of C objects is the target: the one of least cost, by position, size and shape.
///
/// The cost is half the squared Mahalanobis distance of (X, Y, Z, W, H) from the expected state, plus, for an object without cut
/// sides, signature_cost times the total variation distance of its distributions from the target's. A size that was never visible
/// as a whole is a lower bound: a larger size, and the center along its axis, are weighted by `unknown`. With `complete`, an
/// object that is cut is extended to the mean size beyond the sides that are cut; between two opposite ones it is as near to the
/// expected center as its visible part allows.
///
/// @param others float64 (C,): nats that are added to each object's cost; (0,) for none
/// @param signature float64 (2 bins + 2,): the target's columns and rows, and two numbers that aren't read
/// @param complete whether objects count as completed where they are cut
/// @returns int: the number of the object, the first of equal ones; -1 where none is the target
/// @throws std::invalid_argument on other shapes or values
/// Source: Sabeti, Parvizi, Wu 2008, section IV.A, for the features that tell objects apart; the cost is ours.
int match_object(const ObjectFeatures& objects, VectorRef others, const ExpectedBody& expected,
                 VectorRef signature, const MatchCosts& costs, bool complete);

}  // namespace tricue
