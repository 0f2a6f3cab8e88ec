// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// A correlation filter with K channels: what correlation_response takes.
struct CorrelationFilter {
    Complexes numerator;  ///< K R x (C / 2 + 1): the planes one below the other
    Floats denominator;   ///< R x (C / 2 + 1)
};

/// A correlation filter with new cells of K channels blended in.
///
/// Equation (5): A_k = Y conj(X_k) and B = sum_k |X_k|², X_k the spectrum of channel k times the focus; both become
/// (1 - rate) old + rate new, so a rate of 1 starts them. What the focus leaves out, cells times (1 - focus), should be answered by 0
/// and only adds its energy, `background` times, to B.
///
/// @param cells       K x R x C, tapered already; at least one channel and cell
/// @param focus       R x C, usually 1 on the target and 0 far from it
/// @param label       R x (C / 2 + 1), Y: the spectrum, as numpy.fft.rfft2's, of the wanted answer, its peak at (0, 0)
/// @param numerator   K x R x (C / 2 + 1), A until now
/// @param denominator R x (C / 2 + 1), B until now
/// @param rate        0 to 1
/// @param background  finite, not negative
/// @throws std::invalid_argument on other shapes, and on numbers out of range
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST), section 3.1; focus and background are ours.
CorrelationFilter correlation_train(const FloatStack& cells, FloatsRef focus, ComplexesRef label,
                                    const ComplexStack& numerator, FloatsRef denominator, double rate,
                                    double background);

}  // namespace tricue
