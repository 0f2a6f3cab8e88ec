// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// Explicit skin rule for uniform daylight: 1 where R > 95, G > 40, B > 20, max - min > 15, |R - G| > 15, R > G and R > B, else 0.
///
/// @param samples uint8 (N, 3, n): N ellipses, channels B, G, R
/// @returns float32 (N, n) of 0 and 1
/// Source: Peer, Kovac, Solina 2003; the region-based model of Sabeti, Parvizi, Wu 2008, figure 1.
Floats skin_rule(const SampleView& samples);

}  // namespace tricue
