// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/gray_cells.hpp"
#include "base/region.hpp"

namespace tricue {

/// The rows of a gray image that block matching compares, Sobel-filtered or not, over a region that may extend beyond the image,
/// where the border is replicated. Only the region is converted to gray and filtered.
class PrefilteredRows {
public:
    static constexpr int kClip = 31;

    /// @param sobel   the x-Sobel filter clipped at ±kClip, as 0 to 2 kClip, else the gray levels themselves
    /// @param padding readable bytes after each row
    PrefilteredRows(GrayCells image, const Region& region, bool sobel, int padding);

    /// The row from column region.x0 on; any y.
    const std::uint8_t* row(int y) const;

private:
    int first_, last_;  ///< the rows that are stored
    std::size_t stride_;
    std::vector<std::uint8_t> rows_;
};

}  // namespace tricue
