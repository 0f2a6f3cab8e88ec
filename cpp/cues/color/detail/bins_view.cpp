// SPDX-License-Identifier: MIT
#include "cues/color/detail/bins_view.hpp"

#include <algorithm>
#include <string>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

/// One more than the largest bin; kNoBin wraps around to 0.
TRICUE_MULTIVERSION
std::uint16_t end_of_bins(const std::uint16_t* bins, std::ptrdiff_t n) {
    std::uint16_t end = 0;
    for (std::ptrdiff_t k = 0; k < n; ++k) end = std::max(end, static_cast<std::uint16_t>(bins[k] + 1));
    return end;
}

}  // namespace

void require_bins(const BinsView& bins, std::ptrdiff_t size) {
    if (size < 1 || size > kNoBin) refuse("size", "1 to 65535 bins", size);
    const int end = end_of_bins(bins.data, std::ptrdiff_t{bins.rows} * bins.cols);
    if (end > size)
        refuse("bins", "bins below " + std::to_string(size) + ", or 65535 for none", std::to_string(end - 1));
}

void require_mask(const ImageView& mask, const BinsView& bins) {
    if (mask.data != nullptr) require_same_shape(mask, bins, "mask");
}

}  // namespace tricue
