// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// Response of a correlation filter over scales, equation (6) along one dimension: the inverse Fourier transform of Σ_d A_d Z_d /
/// (B + λ).
///
/// λ is ridge max(mean of B, 1e-12). Sums over the channels have sixteen parts, d modulo 16.
///
/// @param looks float32 (S, D): D features of a target at S steps of scale, D at least 1
/// @param numerator complex64 (S // 2 + 1, D), A: non-negative frequencies, in the order of numpy.fft.rfft
/// @param denominator float32 (S // 2 + 1,), B, at least 0
/// @param ridge finite, above 0
/// @returns float32 (S,): no change of scale is at S // 2
/// @throws std::invalid_argument on other shapes, or a ridge out of range
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST), section 3.2.
Eigen::ArrayXf scale_response(FloatsRef looks, ComplexesRef numerator, FloatsRef denominator, double ridge);

}  // namespace tricue
