// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/image_view.hpp"
#include "base/region.hpp"

namespace tricue {

/// A part of a gray image that owns its pixels.
struct GrayImage {
    int rows, cols;  ///< of the whole image
    Region part;
    std::vector<std::uint8_t> pixels;

    /// Of the whole image, of which only the part may be read.
    ImageView view() const {
        const std::ptrdiff_t stride = part.x1 - part.x0;
        return {pixels.data() - (part.y0 * stride + part.x0), rows, cols, 1, stride};
    }
};

/// Parts of all levels of the image's pyramid but the first, parts[0] being of the second. Each level is every second pixel of the one
/// before, smoothed by 1, 4, 6, 4, 1 and rounded; the border is replicated. A part holds the source of the next one.
std::vector<GrayImage> coarser_levels(const ImageView& image, const std::vector<Region>& parts);

/// What a part of a level is made of, in the next finer level of that size.
Region finer_source(const Region& part, int rows, int cols);

/// A gray image for bilinear interpolation: each entry packs a pixel with its right, lower and lower right neighbors, for one load.
class QuadImage {
public:
    /// @param part of the image, not empty, that is read; a neighbor of it must be readable, too
    QuadImage(const ImageView& image, const Region& part);

    /// The image at (x0 + i - u[i], y - v[i]), i = 0 to n - 1, bilinear; the border is replicated. Undefined for what is not in the part.
    void warped_row(int y, int x0, const float* u, const float* v, int n, float* out) const;

private:
    int rows_, cols_;
    Region part_;
    std::vector<std::uint32_t> quads_;
};

}  // namespace tricue
