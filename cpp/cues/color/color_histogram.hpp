// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// Color histograms of the samples of each ellipse, with equal bins and a sum of 1 in each channel.
///
/// @param samples uint8 (N, 3, n): N ellipses, channels B, G, R, n at least 1
/// @param bins bins per channel, a divisor of 256
/// @returns float32 (N, 3 bins): the bins of blue, of green, of red
/// @throws std::invalid_argument on bins that do not divide 256, or n = 0
/// Source: the model with 16 bins that Sabeti, Parvizi, Wu 2008 compare with in figure 2.
Floats color_histogram(const SampleView& samples, int bins);

}  // namespace tricue
