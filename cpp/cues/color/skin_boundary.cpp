// SPDX-License-Identifier: MIT
#include "cues/color/skin_boundary.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

// In bytes as far as possible: |a - b| as max - min needs no wider lanes.
inline std::uint8_t distance(std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::max(a, b) - std::min(a, b));
}

}  // namespace

TRICUE_MULTIVERSION
void skin_boundary_row(const std::uint8_t* __restrict pixels, int n, const Bgr& reference,
                       std::int16_t* __restrict boundary) {
    const std::uint8_t b0 = reference[0], g0 = reference[1], r0 = reference[2];
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) {
        const std::uint8_t b = pixels[3 * x], g = pixels[3 * x + 1], r = pixels[3 * x + 2];
        const std::uint8_t delta =
            std::max(distance(b, b0), std::max(distance(g, g0), distance(r, r0)));  // (8)
        const std::uint8_t eta = std::max(b, std::max(g, r));                       // (9)
        boundary[x] = static_cast<std::int16_t>(eta - delta);                       // (10)
    });
}

Boundary skin_boundary(const ImageView& image, const Bgr& reference) {
    Boundary boundary(image.rows, image.cols);
    for (int y = 0; y < image.rows; ++y)
        skin_boundary_row(image.row(y), image.cols, reference,
                          boundary.data() + std::ptrdiff_t{y} * image.cols);
    return boundary;
}

int least_skin(double threshold) {
    if (!(threshold >= -1.0 && threshold <= 1.0)) refuse("threshold", "a number in [-1, 1]", threshold);
    return static_cast<int>(std::floor(255.0 * threshold)) + 1;
}

}  // namespace tricue
