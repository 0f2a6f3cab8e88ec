// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "cues/color/detail/bins_view.hpp"

namespace tricue {

using Counts = Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// For each ellipse how many pixels of each bin are inside, and how many in the ring around it.
struct EllipseCounts {
    Counts inside;  ///< int32 (N, size): pixels of each bin inside the ellipse
    Counts around;  ///< int32 (N, size): pixels of each bin in the ring
};

/// Histograms of the bins inside each ellipse, and in the ring around it, over all pixels of each.
///
/// A pixel is inside where its center (column + 0.5, row + 0.5) is. The ring is the ellipse scaled by `margin`, without the
/// ellipse. Pixels outside the image, those without a bin and those that the mask leaves out count nowhere.
///
/// @param bins uint16 (H, W), as color_bins gives them, may be empty; 65535 is no bin
/// @param ellipses float64 (N, 4): center x, y, semi-axes along x (minor) and y (major), pixels of the bins, finite, axes above 0
/// @param size bins of a histogram, 1 to 65535
/// @param margin 1 (no ring) to 16; times the semi-axes at most 4096 pixels
/// @param mask uint8 (H, W), not 0 where a pixel counts; None for all
/// @throws std::invalid_argument on other shapes or values, or a bin that is not below size
/// Source: Moreno, Tarrida, Andrade-Cetto, Sanfeliu 2002, section 3.1: M and C of equation (1); the ring is ours.
EllipseCounts ellipse_histogram(const BinsView& bins, StatesRef ellipses, int size, double margin,
                                const ImageView& mask);

}  // namespace tricue
