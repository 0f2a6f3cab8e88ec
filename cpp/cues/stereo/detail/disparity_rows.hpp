// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cues/stereo/detail/block_matching.hpp"

namespace tricue {

/// Turns what find_matches found for `n` pixels into disparities, first + at and a fraction; NaN where there is no candidate, or
/// where the second best costs at most `uniqueness` percent more (0: whatever it costs).
void refine_matches(const Matches& matches, int n, int first, int candidates, unsigned uniqueness,
                    float* disparity);

/// The left-right check of one row after the other: which pixel claims each column of the right image.
class Claims {
public:
    /// Columns [begin, end) of the right image can be claimed.
    Claims(int begin, int end);

    /// Makes those pixels [x0, x1) NaN whose whole disparity is further than `tolerance` from that of the pixel that
    /// claims the same column at the least cost, of equal ones the leftmost.
    void check(const Matches& matches, int x0, int x1, int first, int tolerance, float* disparity);

private:
    int begin_;
    std::vector<std::uint16_t> cost_;
    std::vector<int> disparity_;
};

}  // namespace tricue
