// SPDX-License-Identifier: MIT
#include "cues/color/color_ranks.hpp"

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/rank_table.hpp"

namespace tricue {
namespace {

template <typename Count>
TRICUE_MULTIVERSION void rank_ellipse(const SampleView& samples, std::ptrdiff_t ellipse, float* ranks) {
    std::array<RankTable<Count>, 3> tables;
    rank_tables(samples, ellipse, tables);
    const auto twice = static_cast<float>(2 * samples.n);
    for (int channel = 0; channel < 3; ++channel) {
        const auto& table = tables[static_cast<std::size_t>(channel)];
        const std::uint8_t* plane = samples.plane(ellipse, channel);
        for (std::ptrdiff_t k = 0; k < samples.n; ++k)
            ranks[channel * samples.n + k] = static_cast<float>(table[plane[k]]) / twice;
    }
}

}  // namespace

Floats color_ranks(const SampleView& samples) {
    if (samples.n < 1) refuse("samples", "at least one an ellipse", "none");
    Floats ranks(samples.ellipses, 3 * samples.n);
    with_count_type(static_cast<std::size_t>(samples.n), [&](auto count) {
        for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i)
            rank_ellipse<decltype(count)>(samples, i, ranks.data() + 3 * i * samples.n);
    });
    return ranks;
}

}  // namespace tricue
