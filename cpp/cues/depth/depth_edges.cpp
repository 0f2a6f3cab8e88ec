// SPDX-License-Identifier: MIT
#include "cues/depth/depth_edges.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "base/check.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"
#include "cues/depth/detail/depth_rows.hpp"

namespace tricue {
namespace {

/// A row with one more float at either end, infinite where nothing was measured.
TRICUE_MULTIVERSION
void pad_row(const float* __restrict depth, int n, float* __restrict padded) {
    for_overlapping_blocks(
        n, [=](std::ptrdiff_t x) { padded[x + 1] = has_depth(depth[x]) ? depth[x] : kUnmeasured; });
}

TRICUE_MULTIVERSION
void edges_of_row(const float* __restrict depth, const float* __restrict above, const float* __restrict here,
                  const float* __restrict below, int n, float gap, float slope,
                  std::uint8_t* __restrict edges) {
    for_overlapping_blocks(n, [=](std::ptrdiff_t x) {
        const float z = depth[x], nearest = smaller(smaller(above[x], here[x]), below[x]);
        edges[x] = is_edge(z, nearest, gap, slope);
    });
}

}  // namespace

void require_gap(double gap, double slope) {
    require_not_negative(gap, "gap");
    require_not_negative(slope, "slope");
}

Labels depth_edges(const DepthView& depth, double gap, double slope) {
    require_gap(gap, slope);
    Labels edges(depth.rows, depth.cols);
    const auto n = static_cast<std::size_t>(depth.cols);
    std::array<std::vector<float>, 2> padded;   // of two rows, in turn
    std::array<std::vector<float>, 3> nearest;  // of three rows, in turn
    padded.fill(std::vector<float>(n + 2, kUnmeasured));
    nearest.fill(std::vector<float>(n, kUnmeasured));
    // A row ahead: numbers that have just been written can't be loaded yet at an offset of one, as stores can't be forwarded.
    const auto pad = [&](int y) {
        if (y < depth.rows) pad_row(depth.row(y), depth.cols, padded[static_cast<std::size_t>(y) % 2].data());
    };
    const auto read_row = [&](int y) {
        auto& row = nearest[static_cast<std::size_t>(y) % 3];
        pad(y + 1);
        if (y < depth.rows)
            nearest_in_row(padded[static_cast<std::size_t>(y) % 2].data(), depth.cols, row.data());
        else
            std::fill(row.begin(), row.end(), kUnmeasured);
        return row.data();
    };
    pad(0);
    const float *above = nearest[2].data(), *here = read_row(0);
    for (int y = 0; y < depth.rows; ++y) {
        const float* below = read_row(y + 1);
        edges_of_row(depth.row(y), above, here, below, depth.cols, static_cast<float>(gap),
                     static_cast<float>(slope), edges.data() + std::ptrdiff_t{y} * depth.cols);
        above = here;
        here = below;
    }
    return edges;
}

}  // namespace tricue
