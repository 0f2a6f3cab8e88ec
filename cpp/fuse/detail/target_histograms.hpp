// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "base/arrays.hpp"
#include "base/plane_view.hpp"
#include "base/region.hpp"
#include "fuse/detail/block_grid.hpp"
#include "fuse/detail/value_bins.hpp"

namespace tricue {

constexpr std::size_t kMaxMaps = 3;

/// One observation of each pixel: u, v or d, and its reliability.
struct CueMap {
    PlaneView values, weights;
};

/// Sums of weights: in each bin of the target's window and of its surround, and in all of the surround.
struct WindowHistograms {
    Vector target, surround;
    double total;
};

/// Both histograms of each observation, in one pass over the image; each is summed as by weighted_histogram.
///
/// @param maps 1 to kMaxMaps, of one size
/// @param ranges of the bins of each; as many bins for all
/// @param target, near 1 at the target's pixels and where flow counts, else 0; rows have room for whole blocks
std::vector<WindowHistograms> sum_histograms(const std::vector<CueMap>& maps,
                                             const std::vector<ValueRange>& ranges, const Region& window,
                                             const Labels& target, const Labels& near);

}  // namespace tricue
