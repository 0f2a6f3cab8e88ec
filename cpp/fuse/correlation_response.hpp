// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// Responses of F correlation filters with K channels to the same cells: the inverse Fourier transform of Σ_k A_k Z_k.
///
/// Z_k is the spectrum of channel k, computed once for all filters; A_k, channel k of a filter, is the conjugate of the paper's
/// filter, after its division if it has one, equation (6).
///
/// @param cells float32 (K, R, C), already tapered; at least one channel and cell
/// @param filters complex64 (F, K, R, C // 2 + 1), A: non-negative frequencies along x, in the order of numpy.fft.rfft2; F at least 1
/// @returns float32 (F, R, C): a target shifted by (x, y) cells has its peak at row R // 2 + y, column C // 2 + x; in C++ the
///     responses one below the other
/// @throws std::invalid_argument on other shapes
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST), section 3.1; for one channel Bolme et al. 2010.
Floats correlation_response(const FloatStack& cells, const FilterStack& filters);

}  // namespace tricue
