// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// The answer of a correlation filter over scales: how much the looks of a target at S steps of scale, shifted, are as those that
/// scale_train learnt from.
///
/// Equation (6) along one dimension: the inverse transform of sum_d A_d Z_d / (B + lambda), as correlation_response; lambda is ridge
/// times B's mean, which is taken for 1e-12 at least. Sums over the channels have sixteen parts, d modulo 16.
///
/// @param looks       S x D: D channels at every scale, at least one
/// @param numerator   (S / 2 + 1) x D, A: a frequency a row, not negative, as numpy.fft.rfft orders them
/// @param denominator 1 x (S / 2 + 1), B: at least 0
/// @param ridge       finite, above 0
/// @returns           S x 1; no change of scale is at S / 2
/// @throws std::invalid_argument on other shapes, and on a ridge out of range
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST), section 3.2.
Eigen::ArrayXf scale_response(FloatsRef looks, ComplexesRef numerator, FloatsRef denominator, double ridge);

}  // namespace tricue
