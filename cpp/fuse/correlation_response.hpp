// SPDX-License-Identifier: MIT
#pragma once

#include "camera/arrays.hpp"
#include "camera/stack_view.hpp"

namespace tricue {

/// The answer of a correlation filter with many channels to cells of K channels: how much they, shifted, look as those that
/// correlation_train learnt from.
///
/// Equation (6): the inverse transform of sum_k A_k Z_k / (B + lambda), Z_k the spectrum of channel k, the numerator A_k
/// standing for the conjugate of the paper's; lambda is ridge times B's mean, which is taken for 1e-12 at least.
///
/// @param cells       K x R x C, tapered already; at least one channel and cell
/// @param numerator   K x R x (C / 2 + 1), A: non-negative frequencies along x, as numpy.fft.rfft2 orders them
/// @param denominator R x (C / 2 + 1), B: at least 0
/// @param ridge       finite, above 0
/// @returns           R x C; what is shifted by (x, y) cells has its peak at row R / 2 + y, column C / 2 + x
/// @throws std::invalid_argument on other shapes, and on a ridge out of range
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST), section 3.1; for one channel Bolme et al. 2010.
Floats correlation_response(const FloatStack& cells, const ComplexStack& numerator, FloatsRef denominator,
                            double ridge);

}  // namespace tricue
