// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace tricue {

/// Rows that block matching reads or writes need room for this many numbers after their end: it works on whole registers.
constexpr int kMatchPadding = 32;

/// One row of the left image and the same row of the right image, which begins where the first candidate matches the left row;
/// candidate k is k pixels further left.
struct RowPair {
    const std::uint8_t* left;
    const std::uint8_t* right;
};

/// Sums of |left - right|, clipped, over as many rows as the window has, one row of sums for each candidate.
struct ColumnSums {
    std::uint16_t* data;
    std::ptrdiff_t stride;  ///< from one candidate to the next
    int candidates;
};

/// The result for each pixel of a row; kNoCost stands for a missing candidate.
struct Matches {
    std::uint16_t* best;    ///< the least cost
    std::uint16_t* at;      ///< the first candidate that has it
    std::uint16_t* below;   ///< the cost one candidate below
    std::uint16_t* above;   ///< one above; undefined if `at` is the last
    std::uint16_t* second;  ///< the least cost of all but `at` and those next to it
};
constexpr std::uint16_t kNoCost = 65535;

/// How to search the sums.
struct Search {
    int window;       ///< width; the window of pixel x is columns [x, x + window) of the sums
    bool second;      ///< whether the second best is needed; otherwise it is undefined
    bool all_inside;  ///< whether all candidates lie in the right image; otherwise
    const std::uint16_t*
        outside;  ///< outside[x - k] is 0 where candidate k of pixel x does, kNoCost elsewhere
};

/// Moves the window down by a row: in `n` columns of the sums, the differences of the new row's pixels are added, those of the
/// old row's subtracted; each counts as at most `limit`.
void move_down(const RowPair& in, const RowPair& out, int n, std::uint8_t limit, const ColumnSums& sums);

/// Finds the best candidate of `n` pixels.
void find_matches(const ColumnSums& sums, const Search& search, int n, const Matches& matches);

}  // namespace tricue
