// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// Responses of F correlation filters with K channels to the same cells, equation (6): the inverse Fourier transform of Σ_k A_k Z_k
/// / (B + λ).
///
/// Z_k is the spectrum of channel k, computed once for all filters; A_k stands for the conjugate of the paper's. λ is ridge
/// max(mean of the filter's B, 1e-12).
///
/// @param cells float32 (K, R, C), already tapered; at least one channel and cell
/// @param numerators complex64 (F, K, R, C // 2 + 1), A: non-negative frequencies along x, in the order of numpy.fft.rfft2; F at
///     least 1
/// @param denominators float32 (F, R, C // 2 + 1), B, at least 0
/// @param ridge finite, above 0
/// @returns float32 (F, R, C): what is shifted by (x, y) cells has its peak at row R // 2 + y, column C // 2 + x; in C++ the
///     responses one below the other
/// @throws std::invalid_argument on other shapes, or a ridge out of range
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST), section 3.1; for one channel Bolme et al. 2010.
Floats correlation_response(const FloatStack& cells, const FilterStack& numerators,
                            const FloatStack& denominators, double ridge);

}  // namespace tricue
