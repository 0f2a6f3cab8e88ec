// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/depth/detail/object_features.hpp"

namespace tricue {

/// The target that is expected among objects.
struct ExpectedTarget {
    VectorRef state, size;
    bool width_known, height_known;
    VectorRef signature;
};

/// The costs that tell the target from other objects.
struct MatchCosts {
    double x, y, z, share, base;
    double center, larger;
    double signature;
    double max_cost, min_area;
};

/// Which of C objects is the target: the one of least cost, by position, size and shape.
///
/// The cost is half the squared Mahalanobis distance of (X, Y, Z, W, H) from the expected state, plus, for an object without cut
/// sides, signature_cost times the total variation distance of its distributions from the target's. A size that was never visible
/// as a whole is a lower bound: a larger size, and the center along its axis, are weighted by `unknown`. With `complete`, an
/// object that is cut is extended to the mean size beyond the sides that are cut; between two opposite ones it is as near to the
/// expected center as its visible part allows.
///
/// @param measured float64 (C, 8), as measure_objects gives it, finite
/// @param cut bool (C, 4): whether each may continue at the left, right, top, bottom
/// @param columns float32 (C, bins), as depth_components gives them
/// @param rows as columns
/// @param others float64 (C,): nats that are added to each object's cost; (0,) for none
/// @param expected float64 (5,): X, Y, Z, W, H, meters, finite
/// @param mean_size (size, known): float64 (2,), running means of the target's width and height, meters, finite, above 0; bool (2,):
///     whether each was ever visible as a whole
/// @param signature float64 (2 bins + 2,): the target's columns and rows, and two numbers that aren't read
/// @param deviation (x, y, z, share, base): standard deviations of the position, meters, above 0; and of a size, share x size + base,
///     neither negative and not both 0
/// @param unknown (center, larger): weights along an axis on which the size isn't known, finite: of the position, and of a size that
///     exceeds the mean
/// @param signature_cost nats, finite
/// @param gate (max_cost, min_area): the target's cost is below this, nats; its visible part has at least this area, m²
/// @param complete whether objects count as completed where they are cut
/// @returns int: the number of the object, the first of equal ones; -1 where none is the target
/// @throws std::invalid_argument on other shapes or values
/// Source: Sabeti, Parvizi, Wu 2008, section IV.A, for the features that tell objects apart; the cost is ours.
int match_object(const ObjectFeatures& objects, VectorRef others, const ExpectedTarget& expected,
                 const MatchCosts& costs, bool complete);

}  // namespace tricue
