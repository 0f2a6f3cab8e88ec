// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// Moves the first of M rank maps toward the ranks that are seen: new = old + rate (seen - old), in float32. The others stay.
///
/// @param models float32 (M, 3, n): rank maps, M at least 1; in C++ M rows of 3 n
/// @param ranks float32 (3, n): as rank_window gives them; in C++ one row of 3 n
/// @param rate learning rate, in [0, 1]
/// @returns float32 (M, 3, n): all maps
/// @throws std::invalid_argument on other shapes, or a rate out of range
/// Source: the update of the model, Sabeti, Parvizi, Wu 2008, section III.
Floats learn_ranks(FloatsRef models, FloatsRef ranks, double rate);

}  // namespace tricue
