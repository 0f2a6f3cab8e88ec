// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// Looks up the color of each sample in a table: table[b B // 256, g B // 256, r B // 256].
///
/// @param samples uint8 (N, 3, n): N ellipses, channels B, G, R
/// @param table float32 (B, B, B), B a power of two up to 64; in C++ B² rows (blue, green) of B reds
/// @returns float32 (N, n)
/// @throws std::invalid_argument on a table of another size
/// Source: the normalized look-up table of Vezhnevets, Sazonov, Andreeva 2003, section 3.1; the histogram model of Sabeti, Parvizi,
/// Wu 2008, figure 1.
Floats color_lookup(const SampleView& samples, FloatsRef table);

}  // namespace tricue
