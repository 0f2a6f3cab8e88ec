// SPDX-License-Identifier: MIT
#include "cues/color/color_ranks.hpp"

#include "check.hpp"
#include "rank_table.hpp"
#include "simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void rank_channel(const std::uint8_t* samples, std::size_t n, float* ranks) {
    with_count_for(n, [&](auto count) {
        RankTable<decltype(count)> table;
        rank_table(samples, n, table);
        const auto twice = static_cast<float>(2 * n);
        for (std::size_t k = 0; k < n; ++k) ranks[k] = static_cast<float>(table[samples[k]]) / twice;
    });
}

}  // namespace

Floats color_ranks(const SampleView& samples) {
    if (samples.n < 1) refuse("samples", "at least one an ellipse", "none");
    Floats ranks(samples.ellipses, 3 * samples.n);
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i)
        for (int channel = 0; channel < 3; ++channel)
            rank_channel(samples.plane(i, channel), static_cast<std::size_t>(samples.n),
                         ranks.data() + (3 * i + channel) * samples.n);
    return ranks;
}

}  // namespace tricue
