// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// Distance between orders of corresponding pixels: twice the mean absolute difference between the mid-ranks of an ellipse's
/// samples (color_ranks) and those that a model expects at the same places.
///
/// 0 is the same order, 2/3 unrelated orders, 1 the opposite order. Any strictly increasing change of a channel of the image
/// leaves the distance unchanged. A model's ranks are rounded to the nearest multiple of 1/(2n), as those of samples are, so the
/// distance is exact to its last rounding.
///
/// @param samples uint8 (N, 3, n): N ellipses, channels B, G, R, n at least 1
/// @param models float32 (M, 3, n): rank maps in [0, 1]; in C++ M rows of 3 n
/// @returns float64 (N, M) in [0, 1]
/// @throws std::invalid_argument on n = 0, models of another n, or ranks outside [0, 1]
/// Source: Sabeti, Parvizi, Wu 2008, the order of corresponding pixels that section III.B argues for; its printed equations
/// (19)-(29) are rank_sections and section_distance.
States rank_distance(const SampleView& samples, FloatsRef models);

}  // namespace tricue
