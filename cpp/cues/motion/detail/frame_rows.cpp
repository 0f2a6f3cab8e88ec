// SPDX-License-Identifier: MIT
#include "cues/motion/detail/frame_rows.hpp"

#include <algorithm>

#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void to_floats(const std::uint8_t* __restrict from, int n, float* __restrict to) {
    for_overlapping_blocks<16>(n, [=](std::ptrdiff_t x) { to[x] = from[x]; });
}

}  // namespace

void read_frame_row(const ImageView& image, int y, int x0, int n, float* out) {
    const std::uint8_t* row = image.row(std::clamp(y, 0, image.rows - 1));
    const int begin = std::clamp(-x0, 0, n), end = std::clamp(image.cols - x0, begin, n);
    if (begin > 0) std::fill(out, out + begin, static_cast<float>(row[0]));
    to_floats(row + x0 + begin, end - begin, out + begin);
    if (end < n) std::fill(out + end, out + n, static_cast<float>(row[image.cols - 1]));
}

}  // namespace tricue
