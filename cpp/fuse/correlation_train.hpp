// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// A correlation filter with K channels as it is learned. correlation_response takes A / (B + λ) with a small λ > 0.
struct CorrelationFilter {
    Complexes numerator;  ///< complex64 (K, R, C // 2 + 1), A; in C++ the planes one below the other
    Floats denominator;   ///< float32 (R, C // 2 + 1), B
};

/// Updates a correlation filter with K channels with new cells, equation (5):
///     A_k = Y conj(X_k),   B = Σ_k |X_k|²,   both become (1 - rate) old + rate new
///
/// X_k is the spectrum of channel k.
///
/// @param cells float32 (K, R, C), already tapered; at least one channel and cell
/// @param label complex64 (R, C // 2 + 1), Y: the spectrum of the desired response, its peak at (0, 0), as by numpy.fft.rfft2
/// @param numerator complex64 (K, R, C // 2 + 1), A so far
/// @param denominator float32 (R, C // 2 + 1), B so far
/// @param rate learning rate, in [0, 1]; 1 starts the filter
/// @throws std::invalid_argument on other shapes, or numbers out of range
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST), section 3.1.
CorrelationFilter correlation_train(const FloatStack& cells, ComplexesRef label,
                                    const ComplexStack& numerator, FloatsRef denominator, double rate);

}  // namespace tricue
