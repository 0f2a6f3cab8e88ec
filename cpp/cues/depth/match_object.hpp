// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "cues/depth/detail/object_features.hpp"

namespace tricue {

/// The target, as it is expected among objects.
struct ExpectedTarget {
    VectorRef state, size;
    bool width_known, height_known;
    VectorRef signature;
};

/// What tells the target from other objects.
struct MatchCosts {
    double x, y, z, share, base;
    double center, larger;
    double signature;
    double max_cost, min_area;
};

/// Which of C objects is the target: that of the least cost against the expected state, by position, size and shape.
///
/// The cost is half the squared Mahalanobis distance of (X, Y, Z, W, H) from the expected state, plus, for an object that nothing cuts,
/// signature_cost times the total variation distance of its distributions from the target's. A size that was never visible as a
/// whole is a lower bound: what exceeds it, and the center along its axis, count less. With `complete`, an object that is cut is
/// extended to the mean size beyond the sides that are cut; between two of these it is as near to the expected center as its visible
/// part allows.
///
/// @param measured float64 (C, 8), as measure_objects gives it, finite
/// @param cut bool (C, 4): whether it may go on at the left, right, top, bottom
/// @param columns float32 (C, bins), as depth_components gives them
/// @param rows as columns
/// @param others float64 (C,): nats on top of each object's cost; (0,) for none
/// @param expected float64 (5,): X, Y, Z, W, H, meters, finite
/// @param mean_size (size, known): float64 (2,), running means of the target's width and height, meters, finite, above 0; bool (2,):
///     whether each was ever visible as a whole
/// @param signature float64 (2 bins + 2,): the target's columns and rows, and two numbers that aren't read
/// @param deviation (x, y, z, share, base): standard deviations of the position, meters, above 0; and of a size, share x size + base,
///     neither negative and not both 0
/// @param unknown (center, larger): weights along an axis on which the size isn't known, finite: of the position, and of a size that
///     exceeds the mean
/// @param signature_cost nats, finite
/// @param gate (max_cost, min_area): nats, below which the target's cost is; m², of the visible part, at least
/// @param complete whether objects count as completed where they are cut
/// @returns int: the number of the object, the first of equal ones; -1 where none is the target
/// @throws std::invalid_argument on other shapes or values
/// Source: Sabeti, Parvizi, Wu 2008, section IV.A, says by what objects are told apart; the cost is ours.
int match_object(const ObjectFeatures& objects, VectorRef others, const ExpectedTarget& expected,
                 const MatchCosts& costs, bool complete);

}  // namespace tricue
