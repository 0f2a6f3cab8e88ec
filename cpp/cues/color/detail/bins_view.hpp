// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/image_view.hpp"

namespace tricue {

/// No bin: a pixel outside the image.
constexpr std::uint16_t kNoBin = 65535;

/// A read-only, packed image of bins, as returned by color_bins.
struct BinsView {
    const std::uint16_t* data;
    int rows;
    int cols;

    const std::uint16_t* row(int y) const { return data + std::ptrdiff_t{y} * cols; }
};

/// Throws std::invalid_argument unless size is 1 to 65535 and every bin is below it or kNoBin.
void require_bins(const BinsView& bins, std::ptrdiff_t size);

/// Throws std::invalid_argument unless the mask has the shape of the bins, or no data, which means no mask.
void require_mask(const ImageView& mask, const BinsView& bins);

}  // namespace tricue
