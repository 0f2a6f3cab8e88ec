// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/arrays.hpp"
#include "base/image_view.hpp"
#include "base/region.hpp"
#include "cues/color/detail/bins_view.hpp"

namespace tricue {

/// A part of an image of bins, its bins numbered anew: only those that the model has and that occur get a slot of their own.
/// What is counted in a hundred slots is compared with the model many times as fast as in thousands of bins.
struct SlotImage {
    static constexpr std::uint16_t kOutside = 0;    ///< the slot of pixels without a bin
    static constexpr std::uint16_t kUnmatched = 1;  ///< the first slot of bins that the model has nothing of
    static constexpr int kSpread =
        8;  ///< they have this many: neighbours needn't wait for each other's count
    static constexpr std::size_t kPadding = 16;  ///< slots come in multiples of this

    int cols;
    std::vector<std::uint16_t> slots;
    std::vector<std::uint8_t> marks;  ///< 1 where the mask isn't 0; empty without a mask
    std::vector<double> shares;       ///< the model's share of each slot, 0 where it has none

    /// @param bins  all below model.size() or kNoBin
    /// @param model of sum `total`, none negative
    /// @param mask  of the size of `bins`, or data nullptr
    /// @param area  may reach over the edge
    SlotImage(const BinsView& bins, VectorRef model, double total, const ImageView& mask, const Region& area);

private:
    void fill(const BinsView& bins, VectorRef model, double total, const Region& area, const Region& seen);
    void mark(const BinsView& bins, const ImageView& mask, const Region& area, const Region& seen);
};

}  // namespace tricue
