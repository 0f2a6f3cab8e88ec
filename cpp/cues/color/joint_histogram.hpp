// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// The joint color histogram of each ellipse's samples: bins³ cells, index (b bins + g) bins + r of the quantised channels,
/// of sum 1 (all 0 where there are no samples).
///
/// @param samples N ellipses of n samples in 3 channels
/// @param bins    a power of two from 1 to 64
/// @returns       N x bins³
/// @throws std::invalid_argument on another number of bins
/// Source: the non-parametric skin model of Vezhnevets, Sazonov, Andreeva 2003, which the paper compares with.
Floats joint_histogram(const SampleView& samples, int bins);

}  // namespace tricue
