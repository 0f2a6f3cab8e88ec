// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// A correlation filter over S scales with D channels: what scale_response takes.
struct ScaleFilter {
    Complexes numerator;         ///< complex64 (S // 2 + 1, D), A: a frequency per row
    Eigen::ArrayXf denominator;  ///< float32 (S // 2 + 1,), B
};

/// Updates a correlation filter over scales with new looks of a target, equation (5) along one dimension:
///     A_d = Y conj(X_d),   B = Σ_d |X_d|²,   both become (1 - rate) old + rate new
///
/// Sums over the channels have sixteen parts, d modulo 16.
///
/// @param looks float32 (S, D): D features of a target at S steps of scale, D at least 1
/// @param label complex64 (S // 2 + 1,), Y: the spectrum of the desired response, its peak at 0, as of numpy.fft.rfft
/// @param numerator complex64 (S // 2 + 1, D), A so far
/// @param denominator float32 (S // 2 + 1,), B so far
/// @param rate learning rate, in [0, 1]; 1 starts the filter
/// @throws std::invalid_argument on other shapes, or a rate out of range
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST), section 3.2.
ScaleFilter scale_train(FloatsRef looks, ComplexesRef label, ComplexesRef numerator, FloatsRef denominator,
                        double rate);

}  // namespace tricue
