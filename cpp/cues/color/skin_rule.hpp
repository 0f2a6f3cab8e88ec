// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// The explicit skin rule for uniform daylight, for every sample: 1 where
/// R > 95, G > 40, B > 20, max - min > 15, |R - G| > 15, R > G and R > B, else 0.
///
/// @param samples (N, 3, n)
/// @returns       (N, n) of 0 and 1
/// Source: Peer, Kovac, Solina 2003; the region-based model of Sabeti, Parvizi, Wu 2008, figure 1.
Floats skin_rule(const SampleView& samples);

}  // namespace tricue
