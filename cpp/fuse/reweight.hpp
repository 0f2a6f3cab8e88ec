// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "fuse/detail/proposal.hpp"

namespace tricue {

struct Reweighted {
    Vector weights;  ///< N, normalised to sum 1, equation (31)
    double
        log_evidence;  ///< log of the mean weight before normalising: how well the frame fits, natural logarithm
};

/// Weighs the particles that `propose` drew, equation (2) with the mixture as the proposal, in the log domain:
///
///     w = L p / (share N(x; mean, root rootᵀ) + (1 - share) p),    p = N(x; previous + drift, diag(scale²))
///
/// over the K numbers that the detection is about, since the others come from the dynamics and cancel. So w <= L / (1 - share),
/// and w = L where share is 0. The previous weights are equal (particles were resampled). Nothing overflows: where
/// every likelihood is 0 the weights are uniform and the evidence is -infinity.
///
/// The share that `propose` really draws is floor(share N) / N: unbiased where share N is a whole number. The mass that
/// clamping heaps on the bounds counts as if it had not been clamped.
///
/// @param log_likelihood N, natural logarithms, -infinity for the impossible
/// @param proposed       N x D, what `propose` returned
/// @param previous       N x D, what it was given
/// @throws std::invalid_argument on no particles, sizes that don't agree, a log-likelihood that is NaN or +infinity, other
///         numbers that aren't finite, a share outside [0, 1), or (share above 0) one of the first K scales that isn't above 0
/// Source: Sabeti, Parvizi, Wu 2008, equations (2), (30), (31).
Reweighted reweight(VectorRef log_likelihood, StatesRef proposed, StatesRef previous,
                    const Dynamics& dynamics, const Detection& detection);

}  // namespace tricue
