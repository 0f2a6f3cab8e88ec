// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "base/sample_view.hpp"

namespace tricue {

/// Twice the mid-rank of every level as a count, samples below the level + samples up to it: from 0 to 2n, a whole number.
template <typename Count>
using RankTable = std::array<Count, 256>;

/// The most samples whose doubled ranks fit into a count.
template <typename Count>
constexpr std::size_t kMaxSamples = std::numeric_limits<Count>::max() / 2;

/// The tables of the three channels of one ellipse, n <= kMaxSamples<Count>.
///
/// Each step is done for all channels before the next: a vector load has to wait for the narrow stores before it, and that
/// wait then goes into the other channels' work.
template <typename Count>
inline void rank_tables(const SampleView& samples, std::ptrdiff_t ellipse,
                        std::array<RankTable<Count>, 3>& tables) {
    // Neighboring pixels are alike: two histograms per channel, so that a count needn't wait for the one just written.
    alignas(64) Count counts[3][2][256] = {};
    const std::uint8_t* plane[] = {samples.plane(ellipse, 0), samples.plane(ellipse, 1),
                                   samples.plane(ellipse, 2)};
    const std::ptrdiff_t even = samples.n & ~std::ptrdiff_t{1};
    for (std::ptrdiff_t k = 0; k < even; k += 2)
        for (int channel = 0; channel < 3; ++channel)
            for (int lane = 0; lane < 2; ++lane) ++counts[channel][lane][plane[channel][k + lane]];
    if (even < samples.n)
        for (int channel = 0; channel < 3; ++channel) ++counts[channel][0][plane[channel][even]];

    // A word holds several counts, and one multiplication sums them up. None overflows into the next, being at most 2n.
    constexpr auto kCounts = static_cast<int>(sizeof(std::uint64_t) / sizeof(Count));
    constexpr int kWords = 256 / kCounts;
    constexpr std::uint64_t kOnes =
        std::numeric_limits<std::uint64_t>::max() / std::numeric_limits<Count>::max();
    std::uint64_t own[3][std::size_t{kWords}], up_to[3][std::size_t{kWords}], before[3][std::size_t{kWords}];
    for (int channel = 0; channel < 3; ++channel)
        for (int word = 0; word < kWords; ++word) {
            std::uint64_t lane[2];
            std::memcpy(&lane[0], &counts[channel][0][kCounts * word], sizeof lane[0]);
            std::memcpy(&lane[1], &counts[channel][1][kCounts * word], sizeof lane[1]);
            own[channel][word] = lane[0] + lane[1];
            up_to[channel][word] = own[channel][word] * kOnes;
        }
    for (int channel = 0; channel < 3; ++channel) {
        std::uint64_t sum = 0;
        for (int word = 0; word < kWords; ++word) {
            before[channel][word] = sum;
            sum += up_to[channel][word] >> (64 - 8 * sizeof(Count));
        }
    }
    for (int channel = 0; channel < 3; ++channel)
        for (int word = 0; word < kWords; ++word) {
            const std::uint64_t total = up_to[channel][word] + before[channel][word] * kOnes;
            const std::uint64_t twice = 2 * total - own[channel][word];
            std::memcpy(&tables[static_cast<std::size_t>(channel)][static_cast<std::size_t>(kCounts * word)],
                        &twice, sizeof twice);
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
