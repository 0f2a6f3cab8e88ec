// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"
#include "cues/color/detail/bins_view.hpp"

namespace tricue {

/// A part of an image of bins with the bins renumbered: only bins that are in the model and occur in this part get their own
/// index. A histogram of a hundred indices is compared with the model many times faster than one of thousands of bins.
struct CompactBins {
    static constexpr std::uint16_t kOutside = 0;    ///< the index of pixels without a bin
    static constexpr std::uint16_t kUnmatched = 1;  ///< the first index of bins that are empty in the model
    /// The number of indices shared by the bins that are empty in the model, if there are as many: with several, neighboring
    /// pixels needn't wait for each other's count.
    static constexpr int kUnmatchedCount = 8;
    static constexpr std::size_t kPadding = 16;  ///< the number of indices is a multiple of this

    static constexpr std::size_t kMaskPadding = 16;  ///< so that this many can be read from any position

    int cols;
    std::vector<std::uint16_t> indices;
    /// 1 where the mask isn't 0, followed by kMaskPadding numbers; empty without a mask
    std::vector<std::uint8_t> masked;
    std::vector<double> shares;  ///< the model's share of each index, 0 where it has none

    /// @param bins  all below model.size() or kNoBin
    /// @param model of sum `total`, none negative
    /// @param mask  of the size of `bins`, or data nullptr
    /// @param area  may extend beyond the image
    CompactBins(const BinsView& bins, VectorRef model, double total, const ImageView& mask,
                const Region& area);

private:
    void fill_indices(const BinsView& bins, VectorRef model, double total, const Region& area,
                      const Region& visible);
    void fill_masked(const BinsView& bins, const ImageView& mask, const Region& area, const Region& visible);
};

}  // namespace tricue
