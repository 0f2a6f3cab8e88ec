// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "base/arrays.hpp"
#include "fuse/block_counts.hpp"
#include "fuse/detail/disparity_limits.hpp"

namespace tricue {

using BlockFlags = Eigen::Array<bool, Eigen::Dynamic, 1>;

/// The states of N blocks, and their votes.
struct BlockVotes {
    Indices states;   ///< int64 (N,): 0 not the target's, 1 the target's, 2 occluded
    Indices votes;    ///< int64 (N,): frames for a block to become the target's
    Indices against;  ///< int64 (N,): frames for it to leave its state
    BlockFlags core;  ///< bool (N,): blocks for which the target's disparity alone is a vote
    Indices trusted;  ///< int64 (N,): frames for which a block counts in the model after it had target pixels
    Indices without_pixels;  ///< int64 (N,): frames with the target's disparity since it had target pixels
};

/// How many pixels are a vote, and how many votes decide.
struct VoteRules {
    double min_share;                 ///< of a block's pixels, for a vote
    std::int64_t to_add;              ///< votes that make a block the target's
    std::int64_t to_remove;           ///< votes against it that end this
    std::int64_t to_release;          ///< votes against an occluded block that release it
    std::int64_t max_without_pixels;  ///< frames for which disparity alone keeps a block
};

/// The blocks of the target window after the votes of a frame.
///
/// A block with target pixels, or a core block at the target's disparity, gets a vote; with enough votes it becomes the target's.
/// Disparity alone keeps a block for a limited time, as the floor around the feet has it, too. A block of the target at another
/// disparity, without target pixels, gets a vote against it, but not if hardly any disparities are measured: cloth and cardboard
/// without texture have none. A block of the target whose mean disparity is an occluder's, without target pixels, is occluded; it
/// is the target's again at a similar disparity, and released if it shows the background for long.
///
/// `seen` is what block_counts gives; a mean disparity counts if a fifth of the block's pixels or more have one. Numbers of frames
/// are 0 to 2^31 - 1 before the votes.
///
/// @throws std::invalid_argument on sizes that differ, states other than 0 to 2, and numbers of frames out of range
/// Source: Okada, Shirai, Miura 1996, section 4.4 and figure 7; core blocks, trust and release are ours.
BlockVotes block_votes(BlockVotes blocks, const BlockCounts& seen, const DisparityLimits& limits,
                       const VoteRules& rules);

}  // namespace tricue
