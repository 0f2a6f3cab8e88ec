// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// A color histogram of the samples under every ellipse: `bins` equal bins a channel, each channel's sum 1.
///
/// @param samples (N, 3, n), n at least 1
/// @param bins    a divisor of 256
/// @returns       (N, 3 bins): the bins of blue, of green, of red
/// @throws std::invalid_argument on bins that don't divide 256, or on n = 0
/// Source: the model with 16 bins that Sabeti, Parvizi, Wu 2008 compare with in figure 2.
Floats color_histogram(const SampleView& samples, int bins);

}  // namespace tricue
