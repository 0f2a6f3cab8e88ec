// SPDX-License-Identifier: MIT
#include "cues/depth/height_above.hpp"

#include <limits>

#include "base/check.hpp"
#include "base/depth_pixels.hpp"
#include "base/overlapping_blocks.hpp"
#include "base/simd.hpp"

namespace tricue {
namespace {

TRICUE_MULTIVERSION
void height_row(const float* __restrict depth, const float* __restrict across, int n, float down,
                float offset, float* __restrict height) {
    in_blocks(n, [=](std::ptrdiff_t u) {
        const float z = depth[u], h = z * (across[u] + down) + offset;
        height[u] = has_depth(z) ? h : std::numeric_limits<float>::quiet_NaN();
    });
}

}  // namespace

Floats height_above(const DepthView& depth, VectorRef camera, VectorRef plane) {
    auto [across, down] = rays(camera, depth);
    require_size(plane, 4, "plane");
    require_finite(plane, "plane");
    const Eigen::Array4f p = plane.cast<float>();
    for (float& x : across) x = p[0] * x;
    Floats height(depth.rows, depth.cols);
    for (int v = 0; v < depth.rows; ++v)
        height_row(depth.row(v), across.data(), depth.cols, p[1] * down[static_cast<std::size_t>(v)] + p[2],
                   p[3], height.data() + std::ptrdiff_t{v} * depth.cols);
    return height;
}

}  // namespace tricue
