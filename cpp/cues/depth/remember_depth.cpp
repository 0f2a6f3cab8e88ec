// SPDX-License-Identifier: MIT
#include "cues/depth/remember_depth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void replace_own(const float* __restrict before, int n, float z, float reach, float* __restrict depth) {
    for (int x = 0; x < n; ++x) depth[x] = std::abs(depth[x] - z) < reach ? before[x] : depth[x];
}

void require_target(double z, double reach) {
    if (!std::isfinite(z)) refuse("z", "a finite number", z);
    require_not_negative(reach, "reach");
}

}  // namespace

Floats remember_depth(const DepthView& depth, const DepthView& before, const Region& region, double z,
                      double reach) {
    const bool known = before.rows > 0 || before.cols > 0;
    if (known) require_same_shape(before, depth, "before");
    require_target(z, reach);
    Floats seen(depth.rows, depth.cols);
    for (int y = 0; y < depth.rows; ++y) std::copy_n(depth.row(y), depth.cols, seen.row(y).data());
    const int x0 = std::max(region.x0, 0), x1 = std::min(region.x1, depth.cols), y0 = std::max(region.y0, 0),
              y1 = std::min(region.y1, depth.rows);
    if (x0 >= x1) return seen;
    const std::vector<float> nothing(static_cast<std::size_t>(x1 - x0),
                                     std::numeric_limits<float>::quiet_NaN());
    for (int y = y0; y < y1; ++y)
        replace_own(known ? before.row(y) + x0 : nothing.data(), x1 - x0, static_cast<float>(z),
                    static_cast<float>(reach), seen.row(y).data() + x0);
    return seen;
}

}  // namespace tricue
