// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// Joint color histogram of each ellipse's samples: cell (b bins + g) bins + r of the quantized channels.
///
/// @param samples uint8 (N, 3, n): N ellipses, channels B, G, R
/// @param bins bins per channel, a power of two from 1 to 64
/// @returns float32 (N, bins³), each of sum 1, or all 0 where n = 0
/// @throws std::invalid_argument on another number of bins
/// Source: the non-parametric skin model of Vezhnevets, Sazonov, Andreeva 2003, which the paper compares with.
Floats joint_histogram(const SampleView& samples, int bins);

}  // namespace tricue
