// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tricue {

/// Twice the mid-rank of every level, as a count: samples below the level + samples up to it.
using RankTable = std::array<std::int32_t, 256>;

namespace detail {

/// Counts of up to 255 samples fit into bytes; then one multiplication sums eight of them.
inline void rank_table_small(const std::uint8_t* samples, std::size_t n, RankTable& table) {
    // Neighbouring pixels are alike: several histograms, so that a count needn't wait for the one just written.
    alignas(64) std::uint8_t counts[4][256] = {};
    std::size_t k = 0;
    for (; k + 4 <= n; k += 4)
        for (std::size_t lane = 0; lane < 4; ++lane) ++counts[lane][samples[k + lane]];
    for (; k < n; ++k) ++counts[0][samples[k]];

    alignas(64) std::uint8_t own[256], below[256];
    for (std::size_t level = 0; level < 256; ++level)
        own[level] = static_cast<std::uint8_t>(counts[0][level] + counts[1][level] + counts[2][level] +
                                               counts[3][level]);
    constexpr std::uint64_t kOnes = 0x0101010101010101;
    std::uint64_t before = 0;
    for (std::size_t word = 0; word < 256; word += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, own + word, 8);
        const std::uint64_t up_to = eight * kOnes;                   // no byte overflows: n < 256
        const std::uint64_t lower = up_to - eight + before * kOnes;  // and none borrows
        before += up_to >> 56;
        std::memcpy(below + word, &lower, 8);
    }
    for (std::size_t level = 0; level < 256; ++level) table[level] = 2 * below[level] + own[level];
}

inline void rank_table_large(const std::uint8_t* samples, std::size_t n, RankTable& table) {
    table.fill(0);
    for (std::size_t k = 0; k < n; ++k) ++table[samples[k]];
    std::int32_t below = 0;
    for (std::int32_t& level : table) {
        const std::int32_t own = level;
        level = 2 * below + own;
        below += own;
    }
}

}  // namespace detail

/// The table of n samples of one channel; n < 2^30.
inline void rank_table(const std::uint8_t* samples, std::size_t n, RankTable& table) {
    if (n < 256)
        detail::rank_table_small(samples, n, table);
    else
        detail::rank_table_large(samples, n, table);
}

}  // namespace tricue
