// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "base/simd.hpp"

namespace tricue {

/// Twice the mid-rank of every level as a count, samples below the level + samples up to it: from 0 to 2n, a whole number.
///
/// The number of a level is at its place, the level's byte rotated by three bits: row `level % 8`, column `level / 8` of 8 x 32.
/// So sums over eight successive levels are column sums, which vectors add up.
template <typename Count>
using RankTable = std::array<Count, 256>;

/// The most samples whose doubled ranks fit into a count.
template <typename Count>
constexpr std::size_t kMaxSamples = std::numeric_limits<Count>::max() / 2;

/// The places of n levels.
TRICUE_INLINE void rank_places(const std::uint8_t* __restrict levels, std::size_t n,
                               std::uint8_t* __restrict places) {
    for (std::size_t k = 0; k < n; ++k)
        places[k] = static_cast<std::uint8_t>((levels[k] >> 3) | (levels[k] << 5));
}

/// Counts the places of three planes, eight of each at a time, because loading bytes one by one takes as long as counting them.
template <typename Count>
TRICUE_INLINE void count_places(const std::uint8_t* places, std::size_t n, Count (*counts)[2][256]) {
    const std::size_t whole = n & ~std::size_t{7};
    for (std::size_t k = 0; k < whole; k += 8)
        for (std::size_t plane = 0; plane < 3; ++plane) {
            std::uint64_t eight;
            std::memcpy(&eight, places + plane * n + k, sizeof eight);
            for (std::size_t i = 0; i < 8; ++i) ++counts[plane][i & 1][eight >> (8 * i) & 255];
        }
    for (std::size_t plane = 0; plane < 3; ++plane)
        for (std::size_t k = whole; k < n; ++k) ++counts[plane][k & 1][places[plane * n + k]];
}

/// The tables of consecutive planes of n places each, n <= kMaxSamples<Count>; the number of planes is a multiple of three.
///
/// Each step is done for all planes before the next one: a vector load must wait for earlier narrow stores, and the other planes'
/// work fills that wait.
template <typename Count, std::size_t kPlanes>
TRICUE_INLINE void rank_tables(const std::uint8_t* places, std::size_t n,
                               std::array<RankTable<Count>, kPlanes>& tables) {
    constexpr std::size_t kRows = 8, kColumns = 32;
    // Neighboring pixels are alike: two histograms per plane, so that a count needn't wait for the one just written.
    alignas(64) Count counts[kPlanes][2][256] = {};
    for (std::size_t plane = 0; plane < kPlanes; plane += 3)
        count_places(places + plane * n, n, &counts[plane]);

    using Row = Pack<Count, kColumns>;
    Row up_to[kPlanes][kRows];  // the counts from the first level of a column to each of its levels
    for (std::size_t plane = 0; plane < kPlanes; ++plane)
        for (std::size_t row = 0; row < kRows; ++row) {
            Row lane[2];
            for (std::size_t k = 0; k < 2; ++k) load(&counts[plane][k][kColumns * row], lane[k]);
            up_to[plane][row] = lane[0] + lane[1];
            if (row > 0) up_to[plane][row] += up_to[plane][row - 1];
        }

    // The counts before each column. A word holds several, and one multiplication adds them up. None overflows into the next, as
    // each is at most 2n.
    constexpr std::size_t kCounts = sizeof(std::uint64_t) / sizeof(Count);
    constexpr std::size_t kWords = kColumns / kCounts;
    constexpr std::uint64_t kOnes =
        std::numeric_limits<std::uint64_t>::max() / std::numeric_limits<Count>::max();
    Row before[kPlanes];
    for (std::size_t plane = 0; plane < kPlanes; ++plane) {
        std::uint64_t own[kWords], sum = 0;
        store(up_to[plane][kRows - 1], own);
        for (std::uint64_t& word : own) {
            const std::uint64_t inclusive = word * kOnes + sum * kOnes;
            word = inclusive - word;
            sum = inclusive >> (64 - 8 * sizeof(Count));
        }
        load(own, before[plane]);
    }
    for (std::size_t plane = 0; plane < kPlanes; ++plane)
        for (std::size_t row = 0; row < kRows; ++row) {
            Row twice = before[plane] + before[plane] + up_to[plane][row];
            if (row > 0) twice += up_to[plane][row - 1];
            store(twice, &tables[plane][kColumns * row]);
        }
}

/// Calls `use` with a 0 of the smallest type that counts n samples.
template <typename Use>
inline void with_count_type(std::size_t n, Use&& use) {
    if (n <= kMaxSamples<std::uint8_t>)
        use(std::uint8_t{0});
    else if (n <= kMaxSamples<std::uint16_t>)
        use(std::uint16_t{0});
    else
        use(std::uint32_t{0});
}

}  // namespace tricue
