// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/stack_view.hpp"

namespace tricue {

/// Learns a correlation filter with K channels from one frame, kept near the previous filter, and 0 outside of a mask:
///     A = argmin |Σ_k A_k X_k − Y|² + μ Σ_k |A_k − P_k|²
///
/// X_k is the spectrum of channel k; A_k is the conjugate of the papers' filter, as in correlation_response, which takes the
/// result. Cells outside of the mask don't add to the response at the window's center, but the filter also learns from its
/// responses elsewhere, to which they add.
///
/// Two iterations of the alternating direction method of multipliers, from G = H = 0: A minimizes the sum above plus γ Σ_k |A_k −
/// G_k + H_k|², which has a closed form (Sherman and Morrison); G is A + H times the mask; H grows by A − G, and γ tenfold. The
/// result is G. With T = R C, μ is temporal_weight T, and γ begins with penalty T.
///
/// @param cells float32 (K, R, C), already tapered; at least one channel and cell
/// @param mask float32 (R, C), in [0, 1]: the window's cells that may add to the response at its center, usually those around it
/// @param label complex64 (R, C // 2 + 1), Y: the spectrum of the desired response, its peak at (0, 0), as by numpy.fft.rfft2
/// @param previous complex64 (K, R, C // 2 + 1), P: the filter so far, finite
/// @param temporal_weight how strongly the filter is kept near the previous one, finite, at least 0; 0 starts a filter
/// @param penalty how strongly A is kept near G in the first iteration, finite, above 0
/// @returns complex64 (K, R, C // 2 + 1), A; in C++ the planes one below the other
/// @throws std::invalid_argument on other shapes, or numbers out of range
/// Source: Li, Tian, Zuo, Zhang, Yang 2018 (STRCF); the mask is that of Galoogahi, Fagg, Lucey 2017 (BACF).
Complexes regularized_filter(const FloatStack& cells, FloatsRef mask, ComplexesRef label,
                             const ComplexStack& previous, double temporal_weight, double penalty);

}  // namespace tricue
