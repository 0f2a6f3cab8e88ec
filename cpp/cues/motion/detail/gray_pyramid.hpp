// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/image_view.hpp"

namespace tricue {

/// A gray image of its own.
struct GrayImage {
    int rows, cols;
    std::vector<std::uint8_t> pixels;

    ImageView view() const { return {pixels.data(), rows, cols, 1, cols}; }
};

/// Every second pixel, from the first on, of the image smoothed by 1, 4, 6, 4, 1 and rounded; beyond the edge its pixels go on.
GrayImage halved(const ImageView& image);

/// The image, all its levels but the first.
std::vector<GrayImage> smaller_levels(const ImageView& image, int levels);

/// A gray image to be read between its pixels: each holds its right, lower and lower right neighbor too, so that one load does.
class QuadImage {
public:
    explicit QuadImage(const ImageView& image);

    /// The image at (x0 + i - u[i], y - v[i]), i = 0 to n - 1, bilinear; beyond the edge its pixels go on.
    void warped_row(int y, int x0, const float* u, const float* v, int n, float* out) const;

private:
    int rows_, cols_;
    std::vector<std::uint32_t> quads_;
};

}  // namespace tricue
