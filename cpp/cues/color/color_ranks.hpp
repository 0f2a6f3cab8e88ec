// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// The rank of every sample among the samples of its own ellipse and channel, equation (17) as a mid-rank:
/// (samples of a lower level + half of those of the same level) / n.
///
/// (17) as printed counts all samples of the same level; then a wide flat area ranks higher than a narrow one. The middle
/// has no such bias and a mean of 1/2. Any strictly increasing change of a channel leaves its ranks as they are.
///
/// @param samples N ellipses of n >= 1 samples in 3 channels
/// @returns       N x 3n, each in (0, 1): rows of the blue, the green and the red ranks
/// @throws std::invalid_argument where an ellipse has no samples
/// Source: Sabeti, Parvizi, Wu 2008, equation (17); Muselet, Macaire 2006.
Floats color_ranks(const SampleView& samples);

}  // namespace tricue
