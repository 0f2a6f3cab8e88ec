// SPDX-License-Identifier: MIT
#include "cues/depth/detail/depth_rows.hpp"

#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {

TRICUE_MULTIVERSION
void nearest_in_row(const float* __restrict padded, int n, float* __restrict nearest) {
    for_overlapping_blocks(
        n, [=](std::ptrdiff_t x) { nearest[x] = smaller(smaller(padded[x], padded[x + 1]), padded[x + 2]); });
}

TRICUE_MULTIVERSION
void thin_row(const float* __restrict from, std::ptrdiff_t n, std::ptrdiff_t step, float* __restrict to) {
    if (step == 2)
        for (std::ptrdiff_t i = 0; i < n; ++i) to[i] = from[2 * i];
    else
        for (std::ptrdiff_t i = 0; i < n; ++i) to[i] = from[i * step];
}

}  // namespace tricue
