// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// The mid-rank of each sample among the samples of its ellipse and channel: (samples of a lower level + half of those of the same
/// level) / n.
///
/// Equation (17) as printed counts all samples of the same level, so that a large flat area ranks higher than a small one; the
/// mid-rank has no such bias, and a mean of 1/2. Any strictly increasing change of a channel leaves the ranks unchanged.
///
/// @param samples uint8 (N, 3, n): N ellipses, channels B, G, R, n at least 1
/// @returns float32 (N, 3, n), each in (0, 1); in C++ N rows of 3 n
/// @throws std::invalid_argument on n = 0
/// Source: Sabeti, Parvizi, Wu 2008, equation (17); Muselet, Macaire 2006.
Floats color_ranks(const SampleView& samples);

}  // namespace tricue
