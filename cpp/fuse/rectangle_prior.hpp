// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// The usual width and height of a rectangle, and the standard deviation of the logarithm of their ratios to it.
struct UsualSize {
    VectorRef size, spread;
};

/// A measured state, its standard deviations, and what a state far from it loses at most, nats: the measurement may be wrong.
struct MeasuredState {
    VectorRef state, deviation;
    double most;
};

/// What is known of rectangles in metres before any of them is looked at: log-likelihood of their sizes by the usual size, and
/// of the states by a measured one.
///
///     -1/2 Σ (log(s_i / size_i) / spread_i)² - min(1/2 Σ ((x_i - state_i) / deviation_i)², most)
///
/// with s_1, s_2 the width and height, the last two of a state's D numbers x.
///
/// @param states   (N, D), D at least 2; finite, widths and heights above 0
/// @param usual    (2,) each, above 0, finite
/// @param measured state (D,) finite; deviation (D,) above 0, infinite for what wasn't measured; most not negative
/// @returns        (N,) nats
/// @throws std::invalid_argument on other shapes or values
/// Source: ours; the measurement joins the likelihood as in Isard, Blake 1998 (ICondensation) it joins the proposal.
Vector rectangle_prior(StatesRef states, const UsualSize& usual, const MeasuredState& measured);

}  // namespace tricue
