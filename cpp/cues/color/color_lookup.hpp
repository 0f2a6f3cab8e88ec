// SPDX-License-Identifier: MIT
#pragma once

#include "base/arrays.hpp"
#include "base/sample_view.hpp"

namespace tricue {

/// What a table says of every sample's color: table[b B/256, g B/256, r B/256].
///
/// @param samples (N, 3, n)
/// @param table   (B^2, B): rows (blue, green), columns red; B a power of two, at most 64
/// @returns       (N, n)
/// @throws std::invalid_argument on a table of another size
/// Source: the normalised look-up table of Vezhnevets, Sazonov, Andreeva 2003, section 3.1; the histogram
/// model of Sabeti, Parvizi, Wu 2008, figure 1.
Floats color_lookup(const SampleView& samples, FloatsRef table);

}  // namespace tricue
