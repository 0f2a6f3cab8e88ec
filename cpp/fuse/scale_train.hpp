// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// A correlation filter over S scales with D channels: what scale_response takes.
struct ScaleFilter {
    Complexes numerator;  ///< (S / 2 + 1) x D: a frequency a row, not negative, as numpy.fft.rfft orders them
    Eigen::ArrayXf denominator;  ///< S / 2 + 1
};

/// A correlation filter over scales with new looks of a target blended in.
///
/// Equation (5) along one dimension, as correlation_train: A_d = Y conj(X_d) and B = sum_d |X_d|² become (1 - rate) old + rate new, so
/// a rate of 1 starts them. Sums over the channels have sixteen parts, d modulo 16.
///
/// @param looks       S x D: D channels at every scale, at least one
/// @param label       1 x (S / 2 + 1), Y: the spectrum of the wanted answer, its peak at 0
/// @param numerator   (S / 2 + 1) x D, A until now
/// @param denominator 1 x (S / 2 + 1), B until now
/// @param rate        0 to 1
/// @throws std::invalid_argument on other shapes, and on a rate out of range
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST), section 3.2.
ScaleFilter scale_train(FloatsRef looks, ComplexesRef label, ComplexesRef numerator, FloatsRef denominator,
                        double rate);

}  // namespace tricue
