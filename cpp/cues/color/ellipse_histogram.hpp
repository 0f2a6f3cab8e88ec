// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "cues/color/detail/bins_view.hpp"

namespace tricue {

using Counts = Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// For every ellipse how many pixels of each bin are inside, and how many in the ring round it: (N, size) each.
struct EllipseCounts {
    Counts inside, around;
};

/// Counts the bins inside ellipses and in the rings round them, every pixel of each.
///
/// A pixel is inside where its centre, (column + 0.5, row + 0.5), is. The ring is the ellipse `margin` times as large, less the
/// ellipse. Pixels outside the image of bins, and those without a bin, count nowhere.
///
/// @param bins     (H, W), may be empty
/// @param ellipses (N, 4): centre x, y, semi-axes along x (minor) and along y (major), pixels of the bins, finite, above 0
/// @param size     bins of a histogram, 1 to 65535
/// @param margin   1 (no ring) to 16; times the semi-axes at most 4096 pixels
/// @throws std::invalid_argument on other shapes or values, and on a bin that is not below `size`
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.1: M and C of equation (1); the ring is ours.
EllipseCounts ellipse_histogram(const BinsView& bins, StatesRef ellipses, int size, double margin);

}  // namespace tricue
