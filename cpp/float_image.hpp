// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "camera/image_view.hpp"
#include "camera/region.hpp"

namespace tricue {

/// A gray image of floats, with its last column and row once more, so that between any two pixels can be interpolated.
class FloatImage {
public:
    FloatImage(int rows, int cols);
    explicit FloatImage(const ImageView& image);

    int rows() const { return rows_; }
    int cols() const { return cols_; }
    int stride() const { return cols_ + 1; }
    float* row(int y) { return data_.data() + std::ptrdiff_t{y} * stride(); }
    const float* row(int y) const { return data_.data() + std::ptrdiff_t{y} * stride(); }

    /// To be called when all pixels are written.
    void repeat_last();

private:
    int rows_, cols_;
    std::vector<float> data_;
};

/// Every second pixel, from the first on, of the image smoothed by 1, 4, 6, 4, 1; beyond the edge its pixels go on.
FloatImage halved(const FloatImage& image);

/// Pixels (x0 to x0 + n, y); beyond the image its last row or column goes on.
void image_row(const FloatImage& image, int y, int x0, int n, float* out);

/// The image at (x0 + i - u[i], y - v[i]), i = 0 to n - 1, bilinear; beyond the edge its pixels go on.
void warped_row(const FloatImage& image, int y, int x0, const float* u, const float* v, int n, float* out);

}  // namespace tricue
