// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "fuse/detail/proposal.hpp"

namespace tricue {

struct Reweighted {
    Vector weights;  ///< float64 (N,): weights of sum 1, equation (31)
    /// natural logarithm of the mean weight before normalization: how well the frame fits; -infinity where every likelihood is 0
    double log_evidence;
};

/// Weights of the particles that `propose` drew, equation (2) with the mixture as the proposal, in the log domain:
///     w = L p / (share N(x; mean, root rootᵀ) + (1 - share) p),   p = N(x; previous + drift, diag(scale²))
///
/// over the K numbers of the detection; the others come from the dynamics alone and cancel. So w <= L / (1 - share), and w = L
/// where share is 0. Previous weights count as equal, as after resampling; for others, L includes them. Where every likelihood is
/// 0 the weights are uniform.
///
/// The share that `propose` draws is floor(share N) / N: unbiased where share N is a whole number. Clamping to the bounds is
/// ignored: densities are those without it.
///
/// @param log_likelihood float64 (N,): log L, natural logarithms, -infinity for the impossible
/// @param proposed float64 (N, D): what `propose` returned
/// @param previous float64 (N, D): the particles that it was given
/// @throws std::invalid_argument on no particles, different sizes, a log-likelihood of NaN or +infinity, other numbers that are
///     not finite, a share outside [0, 1), or (share above 0) one of the first K scales that is not above 0
/// Source: Sabeti, Parvizi, Wu 2008, equations (2), (30), (31).
Reweighted reweight(VectorRef log_likelihood, StatesRef proposed, StatesRef previous,
                    const Dynamics& dynamics, const Detection& detection);

}  // namespace tricue
