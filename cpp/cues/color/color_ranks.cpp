// SPDX-License-Identifier: MIT
#include "cues/color/color_ranks.hpp"

#include <array>
#include <vector>

#include "base/check.hpp"
#include "base/simd.hpp"
#include "cues/color/detail/rank_table.hpp"

namespace tricue {
namespace {

template <typename Count>
TRICUE_MULTIVERSION void rank_ellipse(const SampleView& samples, std::ptrdiff_t ellipse, std::uint8_t* places,
                                      float* ranks) {
    const auto n = static_cast<std::size_t>(samples.n);
    rank_places(samples.plane(ellipse, 0), 3 * n, places);
    alignas(64) std::array<RankTable<Count>, 3> tables;
    rank_tables(places, n, tables);
    const auto twice = static_cast<float>(2 * n);
    for (std::size_t channel = 0; channel < 3; ++channel)
        for (std::size_t k = channel * n; k < (channel + 1) * n; ++k)
            ranks[k] = static_cast<float>(tables[channel][places[k]]) / twice;
}

}  // namespace

Floats color_ranks(const SampleView& samples) {
    if (samples.n < 1) refuse("samples", "at least one an ellipse", "none");
    Floats ranks(samples.ellipses, 3 * samples.n);
    std::vector<std::uint8_t> places(static_cast<std::size_t>(3 * samples.n));
    with_count_type(static_cast<std::size_t>(samples.n), [&](auto count) {
        for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i)
            rank_ellipse<decltype(count)>(samples, i, places.data(), ranks.data() + 3 * i * samples.n);
    });
    return ranks;
}

}  // namespace tricue
