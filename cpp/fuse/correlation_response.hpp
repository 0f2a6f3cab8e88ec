// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// The answers of F correlation filters with many channels to cells of K channels: how much they, shifted, look as those that
/// correlation_train learnt from. The cells' spectra, most of the work, are found once for all filters.
///
/// Equation (6): the inverse transform of sum_k A_k Z_k / (B + lambda), Z_k the spectrum of channel k, the numerator A_k
/// standing for the conjugate of the paper's; lambda is ridge times the mean of that filter's B, which is taken for 1e-12 at least.
///
/// @param cells        K x R x C, tapered already; at least one channel and cell
/// @param numerators   F x K x R x (C / 2 + 1), A: non-negative frequencies along x, as numpy.fft.rfft2 orders them; F at least 1
/// @param denominators F x R x (C / 2 + 1), B: at least 0
/// @param ridge        finite, above 0
/// @returns            F R x C, the answers one below the other; what is shifted by (x, y) cells has its peak at row R / 2 + y,
///                     column C / 2 + x
/// @throws std::invalid_argument on other shapes, and on a ridge out of range
/// Source: Danelljan, Häger, Khan, Felsberg 2014 (DSST), section 3.1; for one channel Bolme et al. 2010.
Floats correlation_response(const FloatStack& cells, const FilterStack& numerators,
                            const FloatStack& denominators, double ridge);

}  // namespace tricue
