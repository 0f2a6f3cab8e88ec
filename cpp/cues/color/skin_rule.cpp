// SPDX-License-Identifier: MIT
#include "cues/color/skin_rule.hpp"

#include <algorithm>

#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void classify(const std::uint8_t* __restrict blue, const std::uint8_t* __restrict green,
              const std::uint8_t* __restrict red, std::ptrdiff_t n, float* __restrict skin) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t i) {
        const std::int16_t b = blue[i], g = green[i], r = red[i];
        // Where R > G and R > B, R is the maximum and |R - G| is R - G, which is above 15 only where R > G.
        const bool yes = (r > 95) & (g > 40) & (b > 20) & (r - std::min(g, b) > 15) & (r - g > 15) & (r > b);
        skin[i] = yes ? 1.0F : 0.0F;
    });
}

}  // namespace

Floats skin_rule(const SampleView& samples) {
    Floats skin(samples.ellipses, samples.n);
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i)
        classify(samples.plane(i, 0), samples.plane(i, 1), samples.plane(i, 2), samples.n,
                 skin.data() + i * samples.n);
    return skin;
}

}  // namespace tricue
