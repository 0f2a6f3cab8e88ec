// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"

namespace tricue {

/// The running mean of a rectangle's size.
struct MeanSize {
    VectorRef size;  ///< float64 (2,): running mean of width and height, finite, above 0
    /// float64 (2,): standard deviations of the logarithms of their ratios to it, finite, above 0
    VectorRef spread;
};

/// A measured state, which may be wrong.
struct MeasuredState {
    VectorRef state;  ///< float64 (D,): measured state, finite
    /// float64 (D,): its standard deviations, above 0, infinite for numbers that were not measured
    VectorRef deviation;
    double max_cost;  ///< most that a state far from it loses, nats, at least 0
};

/// Log-likelihood of rectangles before their depths are read, by the running mean of their size and by a measured state:
///     -1/2 Σ (log(s_i / size_i) / spread_i)² - min(1/2 Σ ((x_i - state_i) / deviation_i)², max_cost)
///
/// s_1, s_2 are the width and height, the last two of a state's D numbers x.
///
/// @param states float64 (N, D), D at least 2, finite, widths and heights above 0
/// @returns float64 (N,), nats
/// @throws std::invalid_argument on other shapes or values
/// Source: ours; the measurement joins the likelihood as in Isard, Blake 1998 (ICondensation) it joins the proposal.
Vector rectangle_prior(StatesRef states, const MeanSize& mean_size, const MeasuredState& measured);

}  // namespace tricue
