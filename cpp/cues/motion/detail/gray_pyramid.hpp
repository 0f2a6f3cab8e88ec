// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/image_view.hpp"

namespace tricue {

/// A gray image that owns its pixels.
struct GrayImage {
    int rows, cols;
    std::vector<std::uint8_t> pixels;

    ImageView view() const { return {pixels.data(), rows, cols, 1, cols}; }
};

/// All levels of the image's pyramid but the first. Each is every second pixel of the one before, smoothed by 1, 4, 6, 4, 1 and rounded;
/// the border is replicated.
std::vector<GrayImage> coarser_levels(const ImageView& image, int levels);

/// A gray image for bilinear interpolation: each entry packs a pixel with its right, lower and lower right neighbors, for one load.
class QuadImage {
public:
    explicit QuadImage(const ImageView& image);

    /// The image at (x0 + i - u[i], y - v[i]), i = 0 to n - 1, bilinear; the border is replicated.
    void warped_row(int y, int x0, const float* u, const float* v, int n, float* out) const;

private:
    int rows_, cols_;
    std::vector<std::uint32_t> quads_;
};

}  // namespace tricue
