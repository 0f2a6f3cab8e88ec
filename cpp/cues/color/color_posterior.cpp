// SPDX-License-Identifier: MIT
#include "cues/color/color_posterior.hpp"

#include <vector>

#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/color_cells.hpp"

namespace tricue {
namespace {

/// The cells of n pixels in a cube of 2^bits bins a channel.
TRICUE_MULTIVERSION
void find_cells(const std::uint8_t* __restrict pixels, std::ptrdiff_t n, int bits,
                std::int32_t* __restrict cells) {
    const int shift = 8 - bits;
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) {
        const std::int32_t b = pixels[3 * x] >> shift, g = pixels[3 * x + 1] >> shift,
                           r = pixels[3 * x + 2] >> shift;
        cells[x] = (((b << bits) | g) << bits) | r;
    });
}

}  // namespace

Floats color_posterior(const ImageView& image, FloatsRef table) {
    const int bits = bits_of_cube(table, "table");
    Floats posterior(image.rows, image.cols);
    std::vector<std::int32_t> cells(static_cast<std::size_t>(image.cols));
    float* out = posterior.data();
    for (int y = 0; y < image.rows; ++y) {
        find_cells(image.row(y), image.cols, bits, cells.data());
        // Not multiversioned: single loads are faster than gathers on processors with the Downfall mitigation.
        for (const std::int32_t cell : cells) *out++ = table.data()[cell];
    }
    return posterior;
}

}  // namespace tricue
