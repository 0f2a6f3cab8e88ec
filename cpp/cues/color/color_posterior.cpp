// SPDX-License-Identifier: MIT
#include "cues/color/color_posterior.hpp"

#include <vector>

#include "base/color_cells.hpp"

namespace tricue {

Floats color_posterior(const ImageView& image, FloatsRef table) {
    const int bits = bits_of_cube(table, "table");
    Floats posterior(image.rows, image.cols);
    std::vector<std::int32_t> cells(static_cast<std::size_t>(image.cols));
    float* out = posterior.data();
    for (int y = 0; y < image.rows; ++y) {
        pixel_cells(image.row(y), image.cols, bits, cells.data());
        // Not multiversioned: single loads are faster than gathers on processors with the Downfall mitigation.
        for (const std::int32_t cell : cells) *out++ = table.data()[cell];
    }
    return posterior;
}

}  // namespace tricue
