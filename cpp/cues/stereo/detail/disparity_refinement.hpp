// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "cues/stereo/detail/block_matching.hpp"

namespace tricue {

/// Turns the matches of `n` pixels into disparities, first + at and a subpixel fraction. NaN where there is no candidate, or where the
/// second best costs at most `uniqueness` percent more (0: no such test).
void refine_matches(const Matches& matches, int n, int first, int candidates, unsigned uniqueness,
                    float* disparity);

/// The left-right check, row by row: each column of the right image belongs to the pixel that matches it at the least cost.
class LeftRightCheck {
public:
    /// Pixels match columns [begin, end) of the right image.
    LeftRightCheck(int begin, int end);

    /// Sets those pixels of [x0, x1) to NaN whose integer disparity differs by more than `tolerance` from that of the pixel that
    /// matches the same column at the least cost; among equal costs the leftmost.
    void check(const Matches& matches, int x0, int x1, int first, int tolerance, float* disparity);

private:
    int begin_;
    std::vector<std::uint16_t> cost_;
    std::vector<int> disparity_;
};

}  // namespace tricue
