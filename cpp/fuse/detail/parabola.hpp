// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace tricue {

/// The offset of the top of the parabola through a maximum and its neighbors from the maximum, in samples: at most 0.5, as a top
/// farther off would be nearer to a neighbor; 0 if there is no top.
inline double parabola_offset(double before, double maximum, double after) {
    constexpr double kMaxOffset = 0.5;
    const double bend = before - 2 * maximum + after;
    return bend < 0 ? std::min(std::max(0.5 * (before - after) / bend, -kMaxOffset), kMaxOffset) : 0.0;
}

}  // namespace tricue
