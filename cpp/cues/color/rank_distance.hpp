// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// How differently corresponding pixels are ordered: twice the mean absolute difference between the mid-ranks of an ellipse's
/// samples (color_ranks) and those that each model expects at the same places.
///
/// 0: the same order; 2/3: unrelated orders; 1: the opposite order. Any strictly increasing change of a channel of the image
/// leaves it as it is. What the paper argues for in words, the order of corresponding pixels (section III.B); its printed
/// equations (19)-(29) are rank_sections and section_distance.
///
/// A model's ranks are rounded to the nearest that samples can have, a multiple of 1/2n; then all sums are whole numbers, and
/// the distance is exact to its last rounding.
///
/// @param samples N ellipses of n >= 1 samples in 3 channels
/// @param models  M x 3n rank maps in [0, 1]: blue, green, red
/// @returns       N x M, each in [0, 1]
/// @throws std::invalid_argument where an ellipse has no samples, the models have another number of them, or ranks outside [0, 1]
States rank_distance(const SampleView& samples, FloatsRef models);

}  // namespace tricue
