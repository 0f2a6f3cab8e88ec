// SPDX-License-Identifier: MIT
#pragma once

#include "camera/arrays.hpp"
#include "camera/sample_view.hpp"

namespace tricue {

/// How differently corresponding pixels are ordered: twice the mean absolute difference between the mid-ranks of an ellipse's
/// samples (color_ranks) and those that each model expects at the same places.
///
/// 0: the same order; 2/3: unrelated orders; 1: the opposite order. Any strictly increasing change of a channel of the image
/// leaves it as it is. What the paper argues for in words, the order of corresponding pixels (section III.B); its printed
/// equations (19)-(29) are rank_sections and section_distance.
///
/// @param samples N ellipses of n >= 1 samples in 3 channels
/// @param models  M x 3n rank maps in [0, 1]: blue, green, red
/// @returns       N x M, each in [0, 1]
/// @throws std::invalid_argument where an ellipse has no samples, or the models another number of them
Floats rank_distance(const SampleView& samples, FloatsRef models);

}  // namespace tricue
