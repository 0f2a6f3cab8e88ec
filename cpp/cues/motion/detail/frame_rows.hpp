// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/image_view.hpp"

namespace tricue {

/// The rows of a gray image from column x0 on, n pixels each; beyond the image its border is replicated.
class FrameRows {
public:
    FrameRows(const ImageView& image, int x0, int n);

    /// The row, in the image itself or, until the next call, in a buffer.
    const std::uint8_t* row(int y);

private:
    ImageView image_;
    int x0_;
    std::vector<std::uint8_t> room_;  ///< empty if all columns are in the image
};

/// The mean of two rows and the change from one to the other.
struct ComparedRow {
    float *mean, *change;
};

/// For n pixels, a whole number of blocks (row_block.hpp).
void compare_rows(const std::uint8_t* before, const std::uint8_t* now, int n, const ComparedRow& out);

}  // namespace tricue
