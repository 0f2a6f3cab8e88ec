// SPDX-License-Identifier: MIT
#include "cues/color/skin_reference.hpp"

#include <array>
#include <vector>

#include "base/check.hpp"

namespace tricue {
namespace {

constexpr int kShift = 3;  // 256 levels to 32

int cell_of(const std::uint8_t* pixel) {
    return ((pixel[0] >> kShift) << 10) | ((pixel[1] >> kShift) << 5) | (pixel[2] >> kShift);
}

template <typename Visit>
void each_pixel(const ImageView& image, Visit visit) {
    for (int y = 0; y < image.rows; ++y)
        for (const std::uint8_t *pixel = image.row(y), *end = pixel + 3 * image.cols; pixel != end;
             pixel += 3)
            visit(pixel);
}

}  // namespace

Bgr skin_reference(const ImageView& patch) {
    if (patch.rows == 0 || patch.cols == 0) refuse("patch", "at least one pixel", "none");

    std::vector<std::uint32_t> histogram(1 << 15);
    each_pixel(patch,
               [&](const std::uint8_t* pixel) { ++histogram[static_cast<std::size_t>(cell_of(pixel))]; });
    // The largest cell is searched for among the patch's pixels, which are far fewer than the histogram's cells.
    int mode = 0;
    std::uint64_t count = 0;
    each_pixel(patch, [&](const std::uint8_t* pixel) {
        const int cell = cell_of(pixel);
        const std::uint64_t filled = histogram[static_cast<std::size_t>(cell)];
        if (filled > count || (filled == count && cell < mode)) mode = cell, count = filled;
    });

    std::array<std::uint64_t, 3> sum{};
    each_pixel(patch, [&](const std::uint8_t* pixel) {
        if (cell_of(pixel) != mode) return;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += pixel[c];
    });
    Bgr mean{};
    for (std::size_t c = 0; c < 3; ++c)
        mean[c] = static_cast<std::uint8_t>((2 * sum[c] + count) / (2 * count));
    return mean;
}

}  // namespace tricue
