// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace tricue {

/// Twice the mid-rank of every level as a count, samples below the level + samples up to it: from 0 to 2n, a whole number.
template <typename Count>
using RankTable = std::array<Count, 256>;

/// The most samples whose doubled ranks fit into a count.
template <typename Count>
constexpr std::size_t kMostSamples = std::numeric_limits<Count>::max() / 2;

/// The table of n <= kMostSamples<Count> samples of one channel.
template <typename Count>
inline void rank_table(const std::uint8_t* samples, std::size_t n, RankTable<Count>& table) {
    // Neighbouring pixels are alike: several histograms, so that a count needn't wait for the one just written.
    alignas(64) Count counts[4][256] = {};
    std::size_t k = 0;
    for (; k + 4 <= n; k += 4)
        for (std::size_t lane = 0; lane < 4; ++lane) ++counts[lane][samples[k + lane]];
    for (; k < n; ++k) ++counts[0][samples[k]];

    alignas(64) Count own[256];
    for (std::size_t level = 0; level < 256; ++level)
        own[level] =
            static_cast<Count>(counts[0][level] + counts[1][level] + counts[2][level] + counts[3][level]);
    // A word holds several counts, and one multiplication sums them up. None overflows into the next, being at most 2n.
    constexpr std::size_t kCounts = sizeof(std::uint64_t) / sizeof(Count);
    constexpr std::uint64_t kOnes =
        std::numeric_limits<std::uint64_t>::max() / std::numeric_limits<Count>::max();
    std::uint64_t before = 0;
    for (std::size_t level = 0; level < 256; level += kCounts) {
        std::uint64_t word;
        std::memcpy(&word, own + level, sizeof word);
        const std::uint64_t up_to = word * kOnes;
        const std::uint64_t twice = 2 * (up_to + before * kOnes) - word;
        before += up_to >> (64 - 8 * sizeof(Count));
        std::memcpy(table.data() + level, &twice, sizeof twice);
    }
}

/// Calls `use` with a 0 of the smallest type that counts n samples.
template <typename Use>
inline void with_count_for(std::size_t n, Use&& use) {
    if (n <= kMostSamples<std::uint8_t>)
        use(std::uint8_t{0});
    else if (n <= kMostSamples<std::uint16_t>)
        use(std::uint16_t{0});
    else
        use(std::uint32_t{0});
}

}  // namespace tricue
