// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

/// A part of a gray picture as floats, indexed by the rows and columns of the whole picture. A block of unused memory
/// (row_block.hpp) follows its last row.
class GrayPlane {
public:
    GrayPlane() = default;

    /// @param rows, cols the whole picture's; `part` lies in it and isn't empty. Its pixels are undefined so far.
    GrayPlane(const Region& part, int rows, int cols);

    /// Columns [part.x0, part.x1) can be read.
    float* row(int y) { return pixels_.get() + offset(y); }
    const float* row(int y) const { return pixels_.get() + offset(y); }

    const Region& part() const { return part_; }
    int rows() const { return rows_; }
    int cols() const { return cols_; }

private:
    std::ptrdiff_t offset(int y) const {
        return static_cast<std::ptrdiff_t>(y - part_.y0) * (part_.x1 - part_.x0) - part_.x0;
    }

    Region part_{0, 0, 0, 0};
    int rows_ = 0, cols_ = 0;
    std::unique_ptr<float[]> pixels_;  ///< not a vector, which would write zeros first
};

/// `part` of an image.
GrayPlane gray_plane(const ImageView& image, const Region& part);

/// `part` of the picture at half the size, ((rows + 1) / 2, (cols + 1) / 2), smoothed by 1, 3, 3, 1 along both axes: its (i, j)
/// lies between 2 i and 2 i + 1. The border is replicated. It reads downsample_source(part, ...).
GrayPlane downsampled(const ImageView& image, const Region& part);
GrayPlane downsampled(const GrayPlane& picture, const Region& part);

/// The region that downsampled() reads for a part, in a picture of that size.
Region downsample_source(const Region& part, int rows, int cols);

}  // namespace tricue
