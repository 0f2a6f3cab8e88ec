// SPDX-License-Identifier: MIT
#include "cues/stereo/detail/disparity_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

TRICUE_MULTIVERSION
void refine_row(const Matches& matches, int n, int first, int candidates, unsigned uniqueness,
                float* __restrict disparity) {
    const std::uint16_t* __restrict best = matches.best, * __restrict at = matches.at;
    const std::uint16_t* __restrict below = matches.below, * __restrict above = matches.above;
    const std::uint16_t* __restrict second = matches.second;
    for_overlapping_blocks<16>(n, [=](std::ptrdiff_t x) {
        const bool ambiguous =
            (uniqueness > 0) & (second[x] != kNoCost) & (100u * second[x] <= (100u + uniqueness) * best[x]);
        const bool between = (below[x] != kNoCost) & (above[x] != kNoCost) & (at[x] + 1 < candidates);
        const int rise = std::max(below[x], above[x]) - best[x];
        const int lean = below[x] - above[x];
        const float fraction = static_cast<float>(lean) / static_cast<float>(std::max(2 * rise, 1));
        const float whole = static_cast<float>(first + at[x]);
        const float fine = between ? whole + fraction : whole;
        disparity[x] = ambiguous | (best[x] == kNoCost) ? kNone : fine;
    });
}

}  // namespace

void refine_matches(const Matches& matches, int n, int first, int candidates, unsigned uniqueness,
                    float* disparity) {
    refine_row(matches, n, first, candidates, uniqueness, disparity);
}

LeftRightCheck::LeftRightCheck(int begin, int end)
    : begin_(begin), cost_(static_cast<std::size_t>(end - begin)), disparity_(cost_.size()) {}

void LeftRightCheck::check(const Matches& matches, int x0, int x1, int first, int tolerance,
                           float* disparity) {
    const auto whole = [&](int x) { return first + matches.at[x - x0]; };
    const auto claimed = [&](int x) { return static_cast<std::size_t>(x - whole(x) - begin_); };
    std::fill(cost_.begin(), cost_.end(), kNoCost);
    for (int x = x0; x < x1; ++x) {
        const std::uint16_t cost = matches.best[x - x0];
        if (std::isnan(disparity[x - x0]) || cost >= cost_[claimed(x)]) continue;
        cost_[claimed(x)] = cost;
        disparity_[claimed(x)] = whole(x);
    }
    for (int x = x0; x < x1; ++x)
        if (!std::isnan(disparity[x - x0]) && std::abs(disparity_[claimed(x)] - whole(x)) > tolerance)
            disparity[x - x0] = kNone;
}

}  // namespace tricue
