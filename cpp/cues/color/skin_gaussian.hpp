// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// Gaussian of skin chrominance with peak 1: exp(-d² / 2), d² = (c - mean)ᵀ precision (c - mean), c = (Cb, Cr) of BT.601, full
/// range, not rounded:
///     Y = 0.299 R + 0.587 G + 0.114 B,  Cb = 128 + (B - Y) / 1.772,  Cr = 128 + (R - Y) / 1.402
///
/// @param samples uint8 (N, 3, n): N ellipses, channels B, G, R
/// @param mean float64 (2,): Cb, Cr
/// @param precision float64 (2, 2): inverse covariance, symmetric, positive definite
/// @returns float32 (N, n) in [0, 1]
/// @throws std::invalid_argument on other shapes, numbers that are not finite, or a precision that is not positive definite
/// Source: the Gaussian model of Sabeti, Parvizi, Wu 2008, figure 1; Vezhnevets, Sazonov, Andreeva 2003, section 4.2.
Floats skin_gaussian(const SampleView& samples, VectorRef mean, StatesRef precision);

}  // namespace tricue
