// SPDX-License-Identifier: MIT
#include "cues/depth/depth_picture.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

/// Gray levels of one row. The order of the operations is that of the twin, so that both have the same bits.
TRICUE_MULTIVERSION
void find_levels(const float* __restrict depth, int n, float z, float low, float high, float per_meter,
                 std::uint8_t* __restrict levels) {
    for (int x = 0; x < n; ++x) {
        const float near = depth[x] <= high ? depth[x] : high;  // NaN becomes white
        const float inside = near >= low ? near : low;
        levels[x] = static_cast<std::uint8_t>(static_cast<int>((inside - z) * per_meter + 128.0F));
    }
}

}  // namespace

Labels depth_picture(const DepthView& depth, double z, double reach) {
    if (!std::isfinite(z)) refuse("z", "a finite number", z);
    require_positive(reach, "reach");
    Labels levels(depth.rows, depth.cols);
    for (int y = 0; y < depth.rows; ++y)
        find_levels(depth.row(y), depth.cols, static_cast<float>(z), static_cast<float>(z - reach),
                    static_cast<float>(z + reach), static_cast<float>(127 / reach), levels.row(y).data());
    return levels;
}

}  // namespace tricue
