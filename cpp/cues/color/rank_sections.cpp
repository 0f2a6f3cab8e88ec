// SPDX-License-Identifier: MIT
// Ranks are integer counts, n r(l): ties and borders of intervals are then exact, and n cancels.
#include "cues/color/rank_sections.hpp"

#include <array>
#include <cstdlib>

#include "base/check.hpp"

namespace tricue {
namespace {

constexpr std::size_t kLevels = 256;
using Counts = std::array<std::int64_t, kLevels>;

/// (17): the number of samples with at most level l.
Counts cumulative_counts(const std::uint8_t* levels, std::ptrdiff_t n) {
    std::array<std::uint32_t, kLevels> even{}, odd{};
    for (std::ptrdiff_t i = 0; i + 1 < n; i += 2) {
        ++even[levels[i]];
        ++odd[levels[i + 1]];
    }
    if (n % 2) ++even[levels[n - 1]];
    Counts ranks;
    std::int64_t total = 0;
    for (std::size_t l = 0; l < kLevels; ++l) ranks[l] = total += even[l] + odd[l];
    return ranks;
}

/// (21): the first level whose rank is closest to n/S, searched from `level`, where the one for n-1 is.
std::size_t closest_level(const Counts& ranks, std::int64_t n, std::int64_t sections, std::size_t level) {
    const auto distance = [&](std::size_t l) { return std::llabs(ranks[l] * sections - n * ranks.back()); };
    // Ranks ascend, so the distance falls, then rises; levels without a pixel leave it unchanged.
    std::size_t best = level;
    std::int64_t least = distance(level);
    for (++level; level < kLevels; ++level) {
        const std::int64_t here = distance(level);
        if (here > least) break;
        if (here < least) best = level, least = here;
    }
    return best;
}

/// (25): the sum of the ranks from the first level of one border to the last of the next.
std::int64_t sum_between(const Counts& ranks, const Counts& sums, std::size_t first, std::size_t next) {
    std::size_t last = next;
    while (last + 1 < kLevels && ranks[last + 1] == ranks[next]) ++last;
    return sums[last] - (first ? sums[first - 1] : 0);
}

void write_sections(const Counts& ranks, std::int64_t sections, float* out) {
    Counts sums;
    std::int64_t sum = 0;
    for (std::size_t l = 0; l < kLevels; ++l) sums[l] = sum += ranks[l];

    std::array<std::int64_t, kLevels> a;
    std::int64_t total = 0;
    std::size_t border = closest_level(ranks, 0, sections, 0);
    for (std::int64_t n = 0; n < sections; ++n) {
        const std::size_t next = closest_level(ranks, n + 1, sections, border);
        total += a[static_cast<std::size_t>(n)] = sum_between(ranks, sums, border, next);
        border = next;
    }
    for (std::int64_t n = 0; n < sections; ++n)
        out[n] = static_cast<float>(static_cast<double>(a[static_cast<std::size_t>(n)]) /
                                    static_cast<double>(total));
}

}  // namespace

Floats rank_sections(const SampleView& samples, int sections) {
    if (sections < 1 || sections > static_cast<int>(kLevels)) refuse("sections", "1 to 256", sections);
    if (samples.n == 0) refuse("samples", "at least one for each ellipse", "none");
    Floats result(3 * samples.ellipses, sections);
    for (std::ptrdiff_t i = 0; i < samples.ellipses; ++i)
        for (int channel = 0; channel < 3; ++channel)
            write_sections(cumulative_counts(samples.plane(i, channel), samples.n), sections,
                           result.row(3 * i + channel).data());
    return result;
}

}  // namespace tricue
