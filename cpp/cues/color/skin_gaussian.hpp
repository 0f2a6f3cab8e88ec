// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// A Gaussian of skin's chrominance, with peak 1: exp(-d^2 / 2), d^2 = (c - mean)^T precision (c - mean).
///
/// c = (Cb, Cr) of BT.601, full range, not rounded:
///   Y = 0.299 R + 0.587 G + 0.114 B,  Cb = 128 + (B - Y) / 1.772,  Cr = 128 + (R - Y) / 1.402.
///
/// @param samples   (N, 3, n)
/// @param mean      (2,) Cb, Cr
/// @param precision (2, 2) inverse covariance, symmetric, positive definite
/// @returns         (N, n) in [0, 1]
/// @throws std::invalid_argument on other shapes, or what isn't finite, or a precision not positive definite
/// Source: the Gaussian model of Sabeti, Parvizi, Wu 2008, figure 1; Vezhnevets, Sazonov, Andreeva 2003.
Floats skin_gaussian(const SampleView& samples, VectorRef mean, StatesRef precision);

}  // namespace tricue
