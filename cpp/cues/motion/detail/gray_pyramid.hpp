// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "base/image_view.hpp"
#include "base/region.hpp"
#include "cues/motion/detail/frame_rows.hpp"

namespace tricue {

/// A part of a gray image that owns its pixels.
struct GrayLevel {
    int rows, cols;  ///< of the whole image
    Region part;
    std::vector<std::uint8_t> pixels;  ///< and one more block, since rows are read by blocks (row_block.hpp)

    /// A view of the whole image, of which only the part may be read.
    ImageView view() const {
        const std::ptrdiff_t stride = part.x1 - part.x0;
        return {pixels.data() - (part.y0 * stride + part.x0), rows, cols, 1, stride};
    }
};

/// Parts of all pyramid levels of the image except the first; parts[0] is of the second level. Each level is every second pixel
/// of the previous one, smoothed by 1, 4, 6, 4, 1 and rounded; the border is replicated. Each part contains the source of the
/// next one.
std::vector<GrayLevel> coarser_levels(const ImageView& image, const std::vector<Region>& parts);

/// The source of a level's part in the next finer level, which has this size.
Region finer_source(const Region& part, int rows, int cols);

/// Flow along x and y of the pixels of a row.
struct FlowPointers {
    const float *u, *v;
};

/// A gray image for bilinear interpolation: each entry packs a pixel with its right, lower and lower right neighbors, for one load.
class QuadImage {
public:
    /// @param part of the image, not empty, that is read; a neighbor of it must be readable, too
    QuadImage(const ImageView& image, const Region& part);

    /// Compares the image at (x0 + i - u[i], y - v[i]), i = 0 to n - 1, bilinear, with the pixels `now`: the mean of both, and
    /// the change from the image to them. The border is replicated. Undefined outside the part.
    void compare_row(int y, int x0, const FlowPointers& flow, const std::uint8_t* now, int n,
                     const ComparedRow& out) const;

private:
    int rows_, cols_;
    Region part_;
    std::vector<std::uint32_t> quads_;
};

}  // namespace tricue
