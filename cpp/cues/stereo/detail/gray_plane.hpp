// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

/// Rows are measured in whole lines of so many pixels, as the rest of a row one by one would take as long as all before: buffers have
/// the room.
constexpr int kRowLine = 16;  // floats in a cache line

constexpr int whole_lines(int n) {
    return (n + kRowLine - 1) / kRowLine * kRowLine;
}

/// A part of a gray picture as floats, indexed by the rows and columns of the whole picture. A line of room follows its last row.
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

/// A level of a pyramid: the picture itself, or a part of a smaller one. It owns neither.
struct GrayLevel {
    const ImageView* image;  ///< or nullptr
    const GrayPlane* plane;  ///< if not

    int rows() const { return image != nullptr ? image->rows : plane->rows(); }
    int cols() const { return image != nullptr ? image->cols : plane->cols(); }
};

/// `part` of the picture at half the size, ((rows + 1) / 2, (cols + 1) / 2), smoothed by 1, 3, 3, 1 along both axes: its (i, j)
/// lies between 2 i and 2 i + 1. The border is replicated. It reads downsample_source(part, ...).
GrayPlane downsampled(const GrayLevel& level, const Region& part);

/// The region that downsampled() reads for a part, in a picture of that size.
Region downsample_source(const Region& part, int rows, int cols);

}  // namespace tricue
