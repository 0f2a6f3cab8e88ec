// SPDX-License-Identifier: MIT
#include "fuse/block_votes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

constexpr std::int64_t kMaxFrames = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t kOther = 0, kTarget = 1, kOccluded = 2, kTrustedFrames = 3;

/// Not 0 if a state isn't 0, 1 or 2, or a number of frames is negative or above kMaxFrames.
TRICUE_MULTIVERSION
std::uint64_t find_strange(const std::int64_t* states, const std::int64_t* votes, const std::int64_t* against,
                           const std::int64_t* trusted, const std::int64_t* without_pixels,
                           std::ptrdiff_t n) {
    constexpr std::uint64_t kValid = kMaxFrames;
    std::uint64_t strange = 0;
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const auto state = static_cast<std::uint64_t>(states[i]);
        const auto frames =
            static_cast<std::uint64_t>(votes[i] | against[i] | trusted[i] | without_pixels[i]);
        strange |= (frames & ~kValid) | (state & ~std::uint64_t{3}) | (state & state >> 1);
    }
    return strange;
}

/// Frame counts are incremented, so they must be below the largest integer.
void require_counts(const BlockVotes& blocks) {
    if (find_strange(blocks.states.data(), blocks.votes.data(), blocks.against.data(), blocks.trusted.data(),
                     blocks.without_pixels.data(), blocks.states.size()) == 0)
        return;
    for (const auto& [frames, name] : {std::pair{&blocks.votes, "votes"},
                                       {&blocks.against, "against"},
                                       {&blocks.trusted, "trusted"},
                                       {&blocks.without_pixels, "without_pixels"}})
        for (const std::int64_t count : *frames)
            if (count < 0 || count > kMaxFrames)
                refuse(name, "0 to 2147483647 frames", std::to_string(count));
    for (const std::int64_t state : blocks.states)
        if (state < kOther || state > kOccluded) refuse("states", "0, 1 or 2", std::to_string(state));
}

void require_arguments(const BlockVotes& blocks, const BlockCounts& seen) {
    const Eigen::Index count = blocks.states.size();
    const auto require = [count](Eigen::Index size, const char* name) {
        if (size != count) refuse(name, std::to_string(count) + " numbers", std::to_string(size));
    };
    require(blocks.votes.size(), "votes");
    require(blocks.against.size(), "against");
    require(blocks.core.size(), "core");
    require(blocks.trusted.size(), "trusted");
    require(blocks.without_pixels.size(), "without_pixels");
    require(seen.pixels.size(), "pixels");
    require(seen.targets.size(), "targets");
    require(seen.measured.size(), "measured");
    require(seen.mean.size(), "mean");
    require(seen.similar.size(), "similar");
    require_counts(blocks);
}

/// The block's observations in this frame.
struct Observed {
    bool inside, found, same_depth, has_mean, hidden, similar_mean;

    Observed(const BlockCounts& seen, Eigen::Index i, const DisparityLimits& limits, double min_share)
        : inside(seen.pixels[i] > 0) {
        const auto pixels = static_cast<double>(seen.pixels[i]);
        const auto has_share = [&](std::int64_t count) {
            return inside && static_cast<double>(count) >= min_share * pixels;
        };
        found = has_share(seen.targets[i]);
        same_depth = has_share(seen.similar[i]);
        has_mean = inside && static_cast<double>(seen.measured[i]) >= kMinMeasuredShare * pixels;
        hidden = has_mean && seen.mean[i] > limits.occluder && !found;
        similar_mean = has_mean && std::abs(seen.mean[i] - limits.target) <= limits.tolerance;
    }
};

}  // namespace

BlockVotes block_votes(BlockVotes blocks, const BlockCounts& seen, const DisparityLimits& limits,
                       const VoteRules& rules) {
    require_arguments(blocks, seen);
    for (Eigen::Index i = 0; i < blocks.states.size(); ++i) {
        const Observed now(seen, i, limits, rules.min_share);
        const std::int64_t before = blocks.states[i];
        const bool target = before == kTarget, occluded = before == kOccluded;

        std::int64_t& without_pixels = blocks.without_pixels[i];
        without_pixels = now.found ? 0 : without_pixels + (now.same_depth && !now.hidden);
        const bool kept = without_pixels < rules.max_without_pixels;
        blocks.core[i] = blocks.core[i] && kept;

        std::int64_t votes = blocks.votes[i], against = blocks.against[i];
        if (now.found || (now.same_depth && blocks.core[i]))
            ++votes;
        else
            votes = std::max(votes - now.inside, std::int64_t{0});
        const bool away = !now.found && !now.same_depth && !now.hidden && now.has_mean;
        if (away && (target || (occluded && !now.similar_mean)))
            ++against;
        else if (target && (now.found || now.same_depth))
            against = 0;

        std::int64_t& state = blocks.states[i];
        if (before == kOther && votes >= rules.to_add) state = kTarget;
        if (target && now.hidden) state = kOccluded;
        if (occluded && against >= rules.to_release) state = kOther;
        if (occluded && now.similar_mean) state = kTarget;
        if (target && (against >= rules.to_remove || !kept)) state = kOther;

        const bool left = state == kOther && before != kOther;
        blocks.votes[i] = left ? 0 : std::min(votes, rules.to_add);
        blocks.against[i] = state == before ? against : 0;
        std::int64_t& trusted = blocks.trusted[i];
        if (now.found)
            trusted = kTrustedFrames;
        else if (!now.hidden)
            trusted = std::max(trusted - 1, std::int64_t{0});
    }
    return blocks;
}

}  // namespace tricue
